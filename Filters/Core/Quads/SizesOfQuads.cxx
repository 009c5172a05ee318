#include "Quads/SizesOfQuads.h"

#include "Analysis/EdgeDistances.h"
#include "Directions/PrincipalDirections.h"
#include "Mesh/SurfaceSizes.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Crosses/FinerSurface.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

/// The scale of curvatures is the length of edges of quads, within these numbers of edges of the surface.
constexpr double SmallestScale = 1.0, LargestScale = 6.0;
/// The largest curvature that counts, over the mean.
constexpr double LargestBend = 8.0;
/// The least mean curvature, times the diagonal: what bends less is flat.
constexpr double LeastBend = 0.1;
constexpr double LargestSlope = 0.2;

void CheckOptions(const FramedMesh& surface, const QuadOptions& options, const ElementNames& names)
{
  const int faces = surface.Mesh.NumberOfFaces();
  const double given = options.EdgeLength != 0.0 ? options.EdgeLength : options.NumberOfQuads;
  if (!(given > 0.0) || !std::isfinite(given))
  {
    throw InvalidInput((options.EdgeLength != 0.0 ? "QuadOptions::EdgeLength is " : "QuadOptions::NumberOfQuads is ") +
      ShortText(given) + "; make it positive");
  }
  if (!(options.Adaptivity >= 0.0 && options.Adaptivity <= 1.0))
  {
    throw InvalidInput(
      "QuadOptions::Adaptivity is " + ShortText(options.Adaptivity) + "; take a number between 0 and 1");
  }
  if (options.Sizes.size() != 0 && options.Sizes.size() != faces)
  {
    throw InvalidInput("there are " + std::to_string(options.Sizes.size()) + " sizes for " + std::to_string(faces) +
      " faces; give one per face, or none");
  }
  if (!options.Regions.empty() && static_cast<int>(options.Regions.size()) != faces)
  {
    throw InvalidInput("there are " + std::to_string(options.Regions.size()) + " regions for " + std::to_string(faces) +
      " faces; give a number for each face, or none");
  }
  for (int face = 0; face < options.Sizes.size(); ++face)
  {
    if (!(options.Sizes[face] > 0.0) || !std::isfinite(options.Sizes[face]))
    {
      throw InvalidInput(
        "the size of " + names.Face(face) + " is " + ShortText(options.Sizes[face]) + "; make it positive");
    }
  }
}

/// The surface cut open along the sharp edges that become edges of quads, where it does not bend but break.
TriangleMesh CutAtSharpEdges(const FramedMesh& surface, const AlignmentOptions& options)
{
  const TriangleMesh& mesh = surface.Mesh;
  std::vector<char> isSharp(mesh.NumberOfEdges(), 0);
  if (options.AlignSharpEdges)
  {
    for (const Constraint& along : AlongSharpLines(surface, options, 1.0))
    {
      isSharp[mesh.EdgeOf(3 * along.Element + along.Side)] = 1;
    }
  }
  DisjointSets corners(3 * mesh.NumberOfFaces());
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (const int twin = mesh.Twin(h); twin >= 0 && !isSharp[mesh.EdgeOf(h)])
    {
      corners.Unite(h, TriangleMesh::Next(twin));
    }
  }
  std::vector<int> numbers(3 * mesh.NumberOfFaces(), -1), vertices;
  Triangles triangles(mesh.NumberOfFaces(), 3);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    int& number = numbers[corners.Smallest(h)];
    if (number < 0)
    {
      number = static_cast<int>(vertices.size());
      vertices.push_back(mesh.Tail(h));
    }
    triangles(h / 3, h % 3) = number;
  }
  Points points(static_cast<int>(vertices.size()), 3);
  for (int number = 0; number < points.rows(); ++number)
  {
    points.row(number) = mesh.Position(vertices[number]).transpose();
  }
  return TriangleMesh(std::move(points), std::move(triangles));
}

Vector<double> LargerCurvatures(const FramedMesh& surface, double scale, const ExecutionContext& context)
{
  const PrincipalCurvatures curvatures = FindPrincipalDirections(surface, scale, context).Faces;
  return curvatures.Maximum.cwiseAbs().cwiseMax(curvatures.Minimum.cwiseAbs());
}

}

QuadOptions WithSizesAlone(
  const FramedMesh& surface, const QuadOptions& options, const ElementNames& names, const ExecutionContext& context)
{
  CheckOptions(surface, options, names);
  QuadOptions others = options;
  others.Adaptivity = 0.0;
  if (options.Adaptivity == 0.0)
  {
    return others;
  }
  const Vector<double> areas = surface.Mesh.FaceAreas(context);
  const double length = options.EdgeLength > 0.0 ? options.EdgeLength : std::sqrt(areas.sum() / options.NumberOfQuads);
  const SurfaceSizes sizes = SizesOf(surface.Mesh);
  const FramedMesh cut(CutAtSharpEdges(surface, options), context);
  const Vector<double> curvatures =
    LargerCurvatures(cut, std::clamp(length / sizes.MeanEdge, SmallestScale, LargestScale), context);
  const double mean = std::max(curvatures.dot(areas) / areas.sum(), LeastBend / sizes.Diagonal());
  const Vector<double> shorter =
    (1.0 + (curvatures / mean).array().min(LargestBend).square()).pow(-0.5 * options.Adaptivity);
  others.Sizes = options.Sizes.size() > 0 ? Vector<double>(options.Sizes.cwiseProduct(shorter)) : shorter;
  return others;
}

QuadOptions OptionsOf(const QuadOptions& options, const FinerSurface& finer)
{
  QuadOptions others = options;
  const int faces = static_cast<int>(finer.Parents.size());
  others.Sizes.resize(options.Sizes.size() > 0 ? faces : 0);
  others.Regions.resize(options.Regions.empty() ? 0 : faces);
  for (int face = 0; face < others.Sizes.size(); ++face)
  {
    others.Sizes[face] = options.Sizes[finer.Parents[face]];
  }
  for (std::size_t face = 0; face < others.Regions.size(); ++face)
  {
    others.Regions[face] = options.Regions[finer.Parents[face]];
  }
  return others;
}

void LimitGrowth(const TriangleMesh& mesh, Vector<double>& lengths)
{
  Vector<double> atVertices =
    Vector<double>::Constant(mesh.NumberOfVertices(), std::numeric_limits<double>::infinity());
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    atVertices[mesh.Tail(h)] = std::min(atVertices[mesh.Tail(h)], lengths[TriangleMesh::FaceOf(h)] / LargestSlope);
  }
  atVertices = LargestSlope * DistancesAlongEdges(mesh, std::move(atVertices));
  for (int face = 0; face < lengths.size(); ++face)
  {
    const double mean =
      (atVertices[mesh.Tail(3 * face)] + atVertices[mesh.Tail(3 * face + 1)] + atVertices[mesh.Tail(3 * face + 2)]) /
      3.0;
    lengths[face] = std::min(lengths[face], mean);
  }
}

std::vector<double> AtVertices(const TriangleMesh& mesh, const Vector<double>& lengths)
{
  std::vector<double> logarithms(mesh.NumberOfVertices(), 0.0), counts(mesh.NumberOfVertices(), 0.0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    logarithms[mesh.Tail(h)] += std::log(lengths[TriangleMesh::FaceOf(h)]);
    counts[mesh.Tail(h)] += 1.0;
  }
  std::vector<double> means;
  for (std::size_t vertex = 0; vertex < counts.size(); ++vertex)
  {
    means.push_back(counts[vertex] > 0.0 ? std::exp(logarithms[vertex] / counts[vertex]) : 1.0);
  }
  return means;
}

}

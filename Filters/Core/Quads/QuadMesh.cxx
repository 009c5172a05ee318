#include "Quads/QuadMesh.h"

#include "Quads/LengthsOfEdges.h"
#include "Quads/QuadMaking.h"
#include "Quads/QuadRemedies.h"
#include "Quads/SizesOfQuads.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

/// More quads would take gigabytes.
constexpr double MostQuads = 1e7;
/// Edges of the surface are this long at most, over those of quads.
constexpr double LongestEdge = 1.0;
/// Edges of the surface are halved as long as there are no more faces than this per quad.
constexpr double MostFacesPerQuad = 25.0;

void CheckPowers(const FramedMesh& surface, const Vector<Complex>& powers, const ElementNames& names)
{
  const int faces = surface.Mesh.NumberOfFaces();
  if (powers.size() != faces)
  {
    throw InvalidInput("there are " + std::to_string(powers.size()) + " directions for " + std::to_string(faces) +
      " faces; give one per face");
  }
  for (int face = 0; face < faces; ++face)
  {
    if (!std::isfinite(powers[face].real()) || !std::isfinite(powers[face].imag()))
    {
      throw InvalidInput("the direction of " + names.Face(face) + " is not finite; set it to 0 where there is none");
    }
  }
}

/// Gives the quads places and faces of the surface that was cut.
void TakeToParents(const FinerSurface& finer, QuadMesh& mesh)
{
  for (SurfacePlace& place : mesh.Places)
  {
    place = finer.InParent(place);
  }
  const auto toParent = [&finer](int& face) { face = finer.Parents[face]; };
  std::for_each(mesh.Faces.begin(), mesh.Faces.end(), toParent);
  QuadReport& report = mesh.Report;
  report.LeastCovered = report.LeastCovered >= 0 ? finer.Parents[report.LeastCovered] : -1;
  int& farthest = report.Distances.FarthestVertex;
  farthest = farthest >= 0 ? finer.NearVertices[farthest] : -1;
  std::for_each(report.RefinedFaces.begin(), report.RefinedFaces.end(), toParent);
  std::for_each(report.AgainstField.begin(), report.AgainstField.end(),
    [&finer](int& halfedge) { halfedge = finer.HalfedgeOfParent(halfedge); });
  for (std::vector<int>* const numbers : { &report.RefinedFaces, &report.AgainstField })
  {
    std::sort(numbers->begin(), numbers->end());
    numbers->erase(std::unique(numbers->begin(), numbers->end()), numbers->end());
  }
}

LengthsOfEdges CheckedLengths(const TriangleMesh& mesh, const QuadOptions& options)
{
  LengthsOfEdges lengths = FindLengthsOfEdges(mesh, FaceComponents(mesh), options);
  if (const double quads = ExpectedOnFaces(mesh, lengths.OnFaces).sum(); !(quads <= MostQuads))
  {
    throw InvalidInput("there would be " + ShortText(quads) + " quads; make edges longer, or sizes more alike");
  }
  return lengths;
}

}

std::shared_ptr<const FinerSurface> SurfaceForQuads(
  const FramedMesh& surface, const QuadOptions& options, const ExecutionContext& context, const ElementNames& names)
{
  context.Checkpoint(0.0);
  const Vector<double> lengths =
    CheckedLengths(surface.Mesh, WithSizesAlone(surface, options, names, PartOfContext(context, 0.0, 0.0))).OnFaces;
  const double quads = ExpectedOnFaces(surface.Mesh, lengths).sum();
  return HalveLongEdges(
    surface, LongestEdge * lengths, std::max(MostFacesPerQuad * quads, 1.5 * surface.Mesh.NumberOfFaces()), context);
}

namespace
{

QuadMesh MakeWithFactors(const FramedMesh& surface, std::shared_ptr<const FinerSurface> finer,
  const Vector<Complex>& powers, const QuadOptions& asked, const ExecutionContext& context, const ElementNames& names)
{
  const QuadOptions options = WithSizesAlone(surface, asked, names, PartOfContext(context, 0.0, 0.0));
  if (!finer)
  {
    CheckPowers(surface, powers, names);
    return MakeQuadsOfShortEdges(surface, powers, CheckedLengths(surface.Mesh, options), options, context, names);
  }
  const ElementNames namesOfFiner = finer->NamesOf(names);
  CheckPowers(finer->Geometry, powers, namesOfFiner);
  const QuadOptions others = OptionsOf(options, *finer);
  QuadMesh mesh = MakeQuadsOfShortEdges(finer->Geometry, powers, CheckedLengths(finer->Geometry.Mesh, others), others,
    PartOfContext(context, 0.0, 0.8), namesOfFiner);
  if (!mesh.Report.Error.empty()) // components of few triangles may be split triangle by triangle, if they are few
  {
    QuadMesh other = MakeQuadsOfShortEdges(surface, finer->PowersOfParents(surface, powers),
      CheckedLengths(surface.Mesh, options), options, PartOfContext(context, 0.8, 1.0), names);
    if (other.Report.Error.empty())
    {
      return other;
    }
  }
  TakeToParents(*finer, mesh);
  mesh.Finer = std::move(finer);
  return mesh;
}

}

QuadMesh MakeQuads(const FramedMesh& surface, std::shared_ptr<const FinerSurface> finer, const Vector<Complex>& powers,
  const QuadOptions& options, const ExecutionContext& context, const ElementNames& names)
{
  return WithRemedyOfQuads([&] { return MakeWithFactors(surface, std::move(finer), powers, options, context, names); });
}

QuadMesh MakeQuads(const FramedMesh& surface, const Vector<Complex>& powers, const QuadOptions& asked,
  const ExecutionContext& context, const ElementNames& names)
{
  CheckPowers(surface, powers, names);
  const QuadOptions options = WithSizesAlone(surface, asked, names, PartOfContext(context, 0.0, 0.0));
  std::shared_ptr<const FinerSurface> finer =
    SurfaceForQuads(surface, options, PartOfContext(context, 0.0, 0.05), names);
  const Vector<Complex> ofFiner = finer ? finer->PowersOf(surface, powers) : powers;
  return MakeQuads(surface, std::move(finer), ofFiner, options, PartOfContext(context, 0.05, 1.0), names);
}

}

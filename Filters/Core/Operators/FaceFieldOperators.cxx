#include "Operators/FaceFieldOperators.h"

#include "Mesh/FaceProjection.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"

#include <algorithm>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// Keeps 1 / area of slivers finite; relative to the square of the longest side.
constexpr double SmallestArea = 1e-6;

/// A field circulates at no cost through two degenerate faces that share a side of no length, so that these are held. One whose
/// sides all have a length is crossed by a field as its neighbours are: it is hardly held.
double EnergyOfDegenerate(const FaceProjection& P)
{
  constexpr double NoLength = 1e-5; // as in FaceFrames
  const auto squares = P.rowwise().squaredNorm();
  return squares.minCoeff() < NoLength * NoLength * squares.maxCoeff() ? SmallestArea : 1e-6 * SmallestArea;
}

/// Areas of the faces, those of slivers raised.
Vector<double> AreasForInverses(const TriangleMesh& mesh)
{
  Vector<double> areas = mesh.FaceAreas();
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const double squared = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).squaredNorm();
    double& area = areas[TriangleMesh::FaceOf(h)];
    area = std::max(area, SmallestArea * squared);
  }
  return areas;
}

/// P of every face.
std::vector<FaceProjection> AllProjections(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  std::vector<FaceProjection> projections(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        projections[face] = ProjectionOntoSides(mesh, faceFrames, face);
      }
    });
  return projections;
}

/// Adds the entries of one face, whose row in an operator is a vector of the frame.
void AppendFace(RowEntries<double>& row, int face, const Vector2& entries)
{
  row.emplace_back(2 * face, entries[0]);
  row.emplace_back(2 * face + 1, entries[1]);
}

void AppendDivergence(
  const TriangleMesh& mesh, const std::vector<FaceProjection>& projections, int vertex, RowEntries<double>& row)
{
  mesh.VisitFan(vertex,
    [&](int h)
    {
      const int face = TriangleMesh::FaceOf(h);
      const Vector2 opposite = projections[face].row((h + 1) % 3).transpose();
      AppendFace(row, face, -0.5 * QuarterTurn(opposite));
    });
}

void AppendCurl(
  const TriangleMesh& mesh, const std::vector<FaceProjection>& projections, int edge, RowEntries<double>& row)
{
  const int h = mesh.HalfedgeOf(edge);
  const int twin = mesh.Twin(h);
  if (twin >= 0)
  {
    // The halfedges run in opposite directions, so that the jump is a sum.
    for (int side : { h, twin })
    {
      const int face = TriangleMesh::FaceOf(side);
      AppendFace(row, face, -projections[face].row(side % 3).transpose());
    }
  }
}

}

SparseMatrix<double> HalfedgePseudoInverse(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  const int faces = mesh.NumberOfFaces();
  return AssembleMatrix<double>(2 * faces, 3 * faces, context,
    [&](int r, RowEntries<double>& row)
    {
      const int face = r / 2;
      const auto inverse = PseudoInverse(ProjectionOntoSides(mesh, faceFrames, face));
      for (int k = 0; k < 3; ++k)
      {
        row.emplace_back(3 * face + k, inverse(r % 2, k));
      }
    });
}

SparseMatrix<double> FaceGradient(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  return AssembleMatrix<double>(2 * mesh.NumberOfFaces(), mesh.NumberOfVertices(), context,
    [&](int r, RowEntries<double>& row)
    {
      const int face = r / 2;
      const auto inverse = PseudoInverse(ProjectionOntoSides(mesh, faceFrames, face));
      for (int k = 0; k < 3; ++k) // the sides to and from corner k
      {
        row.emplace_back(mesh.FaceCorners()(face, k), inverse(r % 2, (k + 2) % 3) - inverse(r % 2, k));
      }
    });
}

FaceFieldMasses MassesOfFaceFields(const TriangleMesh& mesh)
{
  const Vector<double> areas = AreasForInverses(mesh);
  FaceFieldMasses masses{ Vector<double>::Zero(mesh.NumberOfVertices()), Vector<double>::Zero(mesh.NumberOfEdges()),
    Vector<double>(2 * mesh.NumberOfFaces()) };
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const double third = areas[TriangleMesh::FaceOf(h)] / 3.0;
    masses.Vertices[mesh.Tail(h)] += third;
    masses.Edges[mesh.EdgeOf(h)] += third;
  }
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    masses.Faces.segment<2>(2 * face).setConstant(mesh.FaceArea(face));
  }
  return masses;
}

SparseMatrix<double> FaceFieldSmoothnessFactor(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  const int vertices = mesh.NumberOfVertices();
  const int edges = mesh.NumberOfEdges();
  const std::vector<FaceProjection> projections = AllProjections(mesh, faceFrames, context);
  const FaceFieldMasses masses = MassesOfFaceFields(mesh);
  std::vector<int> degenerate;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (IsDegenerate(projections[face]))
    {
      degenerate.push_back(face);
    }
  }
  return AssembleMatrix<double>(vertices + edges + 2 * static_cast<int>(degenerate.size()), 2 * mesh.NumberOfFaces(),
    context,
    [&](int r, RowEntries<double>& row)
    {
      double mass = 1.0;
      if (r < vertices)
      {
        AppendDivergence(mesh, projections, r, row);
        mass = masses.Vertices[r];
      }
      else if (r < vertices + edges)
      {
        AppendCurl(mesh, projections, r - vertices, row);
        mass = masses.Edges[r - vertices];
      }
      else
      {
        const int k = r - vertices - edges;
        const int face = degenerate[k / 2];
        row.emplace_back(2 * face + k % 2, std::sqrt(EnergyOfDegenerate(projections[face])));
      }
      for (auto& [column, value] : row)
      {
        value /= std::sqrt(mass);
      }
    });
}

Vector<double> FaceFieldFromVectors(const TangentFrames& faceFrames, const Points& vectors)
{
  Vector<double> field(2 * vectors.rows());
  for (int face = 0; face < vectors.rows(); ++face)
  {
    const Complex z = faceFrames.ToComplex(face, vectors.row(face).transpose());
    field.segment<2>(2 * face) << z.real(), z.imag();
  }
  return field;
}

Points VectorsFromFaceField(const TangentFrames& faceFrames, const Vector<double>& field)
{
  Points vectors(field.size() / 2, 3);
  for (int face = 0; face < vectors.rows(); ++face)
  {
    vectors.row(face) = faceFrames.ToVector(face, { field[2 * face], field[2 * face + 1] }).transpose();
  }
  return vectors;
}

}

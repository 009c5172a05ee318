#include "Quads/Crosses/CrossField.h"

#include "Quads/Crosses/PathsAlongEdges.h"
#include "Solvers/Direct/CholeskySolver.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

constexpr double QuarterOfTurn = Pi / 2.0;

std::vector<int> QuarterIndices(const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field)
{
  const Vector<double> indices = SingularityIndices(surface.Mesh, angles.Corners, field.Matching.Rotation, 4);
  std::vector<int> quarters(indices.size());
  for (Eigen::Index vertex = 0; vertex < indices.size(); ++vertex)
  {
    quarters[vertex] = static_cast<int>(std::lround(4.0 * indices[vertex]));
  }
  return quarters;
}

/// Lets each direction of the face of a halfedge go on as the one after that which it went on as.
void AddQuarterTurn(const TriangleMesh& mesh, int halfedge, CrossField& field)
{
  const auto add = [&field](int h, int times)
  {
    signed char& offset = field.Matching.Offsets[h];
    offset = static_cast<signed char>((offset + times + 4) % 4);
  };
  const int edge = mesh.EdgeOf(halfedge);
  field.Matching.Rotation[edge] += mesh.HalfedgeOf(edge) == halfedge ? QuarterOfTurn : -QuarterOfTurn;
  add(halfedge, 1);
  add(mesh.Twin(halfedge), -1);
}

/// The singularities of 1/4 that one vertex is split into.
class Splitting
{
public:
  Splitting(const FramedMesh& surface, const SurfaceAngles& angles, int vertex, double distance, CrossField& field)
    : Surface(surface)
    , Angles(angles)
    , Vertex(vertex)
    , Field(field)
    , Paths(surface.Mesh, vertex, distance)
  {
  }

  /// \return whether there was room.
  bool Split()
  {
    const int count = this->Field.Indices[this->Vertex];
    std::vector<int> free = this->RegularVertices(this->Paths.Shell());
    if (static_cast<int>(free.size()) < count)
    {
      free = this->RegularVertices(this->Paths.Reached());
    }
    if (static_cast<int>(free.size()) < count)
    {
      return false;
    }
    for (int k = 0; k < count; ++k)
    {
      this->MoveTo(this->TakeNearest(free, this->FirstAngle() + 2.0 * Pi * k / count));
    }
    return true;
  }

  /// The faces around the paths.
  void MarkFaces(std::vector<char>& isNear) const
  {
    for (const int vertex : this->Paths.Reached())
    {
      this->Surface.Mesh.VisitFan(vertex, [&isNear](int h) { isNear[TriangleMesh::FaceOf(h)] = 1; });
    }
  }

private:
  std::vector<int> RegularVertices(const std::vector<int>& vertices) const
  {
    std::vector<int> regular;
    std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(regular),
      [this](int vertex) {
        return vertex != this->Vertex && !this->Surface.Mesh.IsBoundaryVertex(vertex) &&
          this->Field.Indices[vertex] <= 0;
      });
    return regular;
  }

  /// Between two directions of the field at the vertex.
  double FirstAngle() const
  {
    const int h = this->Surface.Mesh.OutgoingHalfedge(this->Vertex);
    return this->Field.Angles[TriangleMesh::FaceOf(h)] - std::arg(this->Angles.Sides[h]) + Pi / 4.0;
  }

  /// Removes from a list the vertex that lies nearest to a direction of the tangent plane.
  int TakeNearest(std::vector<int>& vertices, double angle) const
  {
    const auto deviation = [this, angle](int vertex)
    {
      const Vector3 way = this->Surface.Mesh.Position(vertex) - this->Surface.Mesh.Position(this->Vertex);
      return std::abs(std::remainder(std::arg(this->Surface.Vertices.ToComplex(this->Vertex, way)) - angle, 2.0 * Pi));
    };
    const auto nearest = std::min_element(
      vertices.begin(), vertices.end(), [&deviation](int a, int b) { return deviation(a) < deviation(b); });
    const int vertex = *nearest;
    vertices.erase(nearest);
    return vertex;
  }

  void MoveTo(int vertex)
  {
    this->Field.Indices[vertex] += 1;
    this->Field.Indices[this->Vertex] -= 1;
    for (const int h : this->Paths.To(vertex))
    {
      AddQuarterTurn(this->Surface.Mesh, h, this->Field);
    }
  }

  const FramedMesh& Surface;
  const SurfaceAngles& Angles;
  const int Vertex;
  CrossField& Field;
  const PathsAlongEdges Paths;
};

/// The weight of an edge in the energy of rotations: its length over that of the dual edge, limited for thin faces.
double WeightAcross(const TriangleMesh& mesh, const SurfaceAngles& angles, int halfedge)
{
  constexpr double SmallestRatio = 0.05;
  const auto cotangent = [&](int h)
  {
    const Complex quotient = -std::conj(angles.Sides[TriangleMesh::Next(h)]) * angles.Sides[TriangleMesh::Previous(h)];
    return -quotient.real() / std::max(std::abs(quotient.imag()), 1e-9);
  };
  const double ratio = 0.5 * (cotangent(halfedge) + cotangent(mesh.Twin(halfedge)));
  return 1.0 / std::max(std::abs(ratio), SmallestRatio);
}

/// Turns the marked faces by the angles t of the least sum of w_e (r_e + t_g - t_f)^2 over the edges from a face f to a face g, where r_e
/// are their rotations; t = 0 elsewhere.
void RelaxRotations(
  const TriangleMesh& mesh, const SurfaceAngles& angles, const std::vector<char>& isMarked, CrossField& field)
{
  std::vector<int> rows(mesh.NumberOfFaces(), -1);
  int size = 0;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    rows[face] = isMarked[face] ? size++ : -1;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Vector<double> right = Vector<double>::Zero(size);
  const auto add = [&](int h, double weight)
  {
    const int here = rows[TriangleMesh::FaceOf(h)], there = rows[TriangleMesh::FaceOf(mesh.Twin(h))];
    if (here >= 0)
    {
      const int edge = mesh.EdgeOf(h);
      const double sign = mesh.HalfedgeOf(edge) == h ? 1.0 : -1.0;
      entries.emplace_back(here, here, weight * (1.0 + 1e-9));
      right[here] += weight * sign * field.Matching.Rotation[edge];
      if (there >= 0)
      {
        entries.emplace_back(here, there, -weight);
      }
    }
  };
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    if (mesh.Twin(h) >= 0)
    {
      const double weight = WeightAcross(mesh, angles, h);
      add(h, weight);
      add(mesh.Twin(h), weight);
    }
  }
  SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Vector<double> turns;
  CholeskySolver<double>(matrix).Solve(right, turns);
  const auto turnOf = [&rows, &turns](int face) { return rows[face] >= 0 ? turns[rows[face]] : 0.0; };
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    field.Angles[face] += turnOf(face);
  }
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    if (mesh.Twin(h) >= 0)
    {
      field.Matching.Rotation[edge] += turnOf(TriangleMesh::FaceOf(mesh.Twin(h))) - turnOf(TriangleMesh::FaceOf(h));
    }
  }
}

}

SurfaceAngles::SurfaceAngles(const FramedMesh& surface, const ExecutionContext& context)
  : Sides(SideDirections(surface.Mesh, surface.Faces, context))
  , Corners(dmg::Corners(surface.Mesh, this->Sides, surface.Faces, surface.Vertices, context))
{
}

CrossField MatchCrosses(const FramedMesh& surface, const SurfaceAngles& angles, const Vector<Complex>& powers,
  const ExecutionContext& context)
{
  Vector<Complex> directed(powers.size());
  CrossField field;
  field.Angles.resize(powers.size());
  for (Eigen::Index face = 0; face < powers.size(); ++face)
  {
    directed[face] = powers[face] == 0.0 ? Complex(1.0) : powers[face] / std::abs(powers[face]);
    field.Angles[face] = std::arg(directed[face]) / 4.0;
  }
  field.Matching = MatchDirections(surface.Mesh, angles.Sides, directed, 4, context);
  field.Indices = QuarterIndices(surface, angles, field);
  return field;
}

int SplitSingularities(const FramedMesh& surface, const SurfaceAngles& angles, double distance, CrossField& field)
{
  const std::vector<int> indices = field.Indices;
  std::vector<char> isNear(surface.Mesh.NumberOfFaces(), 0);
  int split = 0;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    if (indices[vertex] >= 2)
    {
      Splitting splitting(surface, angles, vertex, distance, field);
      if (splitting.Split())
      {
        splitting.MarkFaces(isNear);
        ++split;
      }
    }
  }
  if (split > 0)
  {
    RelaxRotations(surface.Mesh, angles, isNear, field);
    field.Indices = QuarterIndices(surface, angles, field);
  }
  return split;
}

}

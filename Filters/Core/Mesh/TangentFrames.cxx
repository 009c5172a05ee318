#include "Mesh/TangentFrames.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The area, relative to the longest side squared, below which the cross product of two sides is rounding noise.
constexpr double DegenerateArea = 1e-10;

/// A side of a degenerate face that is shorter than this times the longest one counts as having no length;
/// the square root of DegenerateArea, so that longer ones are parallel to it.
constexpr double DegenerateLength = 1e-5;

struct FaceShape
{
  std::array<Vector3, 3> Sides;
  int Longest;
  Vector3 AreaVector;
  bool IsDegenerate;
};

FaceShape ShapeOf(const TriangleMesh& mesh, int face)
{
  FaceShape shape;
  shape.Longest = 0;
  for (int k = 0; k < 3; ++k)
  {
    shape.Sides[k] = mesh.Position(mesh.Head(3 * face + k)) - mesh.Position(mesh.Tail(3 * face + k));
    if (shape.Sides[k].squaredNorm() > shape.Sides[shape.Longest].squaredNorm())
    {
      shape.Longest = k;
    }
  }
  shape.AreaVector = shape.Sides[0].cross(shape.Sides[1]);
  shape.IsDegenerate = 0.5 * shape.AreaVector.norm() <= DegenerateArea * shape.Sides[shape.Longest].squaredNorm();
  return shape;
}

Complex UnitOf(Complex z)
{
  return z / std::sqrt(std::norm(z));
}

std::array<Complex, 3> SideDirectionsOfDegenerate(const FaceShape& shape)
{
  const double longest = shape.Sides[shape.Longest].norm();
  std::array<Complex, 3> directions;
  directions.fill(-1.0);
  directions[shape.Longest] = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    if (shape.Sides[k].norm() < DegenerateLength * longest)
    {
      directions[k] = Complex(0.0, -1.0) * directions[(k + 1) % 3];
    }
  }
  return directions;
}

/// The unit vector perpendicular to unit \p direction that is nearest to \p wish; any perpendicular
/// one where the wish has no such part.
Vector3 PerpendicularPart(const Vector3& wish, const Vector3& direction)
{
  const Vector3 part = wish - wish.dot(direction) * direction;
  const double norm = part.norm();
  return norm > 1e-6 * wish.norm() ? Vector3(part / norm) : Vector3(direction.unitOrthogonal());
}

void SetFrame(TangentFrames& frames, int element, const Vector3& x, const Vector3& normal)
{
  frames.X.row(element) = x.transpose();
  frames.Y.row(element) = normal.cross(x).transpose();
}

TangentFrames FramesOfSize(int size)
{
  return { Points(size, 3), Points(size, 3) };
}

/// Carries normals from the faces that have one into the degenerate ones, ring by ring.
class DegenerateFrames
{
public:
  DegenerateFrames(const TriangleMesh& mesh, const std::vector<int>& degenerate, TangentFrames& frames)
    : Mesh(mesh)
    , Frames(frames)
    , States(mesh.NumberOfFaces(), Known)
  {
    for (const int face : degenerate)
    {
      this->States[face] = Unknown;
    }
  }

  bool IsUnknown(int face) const { return this->States[face] == Unknown; }
  bool TouchesKnown(int face) const
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      if (this->States[this->Neighbour(h)] == Known)
      {
        return true;
      }
    }
    return false;
  }

  /// All unknown faces that hang together with this one.
  void FillFrom(int first)
  {
    std::vector<int> queue = { first };
    this->States[first] = Queued;
    for (std::size_t next = 0; next < queue.size(); ++next)
    {
      const int face = queue[next];
      Vector3 sum = Vector3::Zero(); // of the normals of known neighbours
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        const int neighbour = this->Neighbour(h);
        if (this->States[neighbour] == Known)
        {
          sum += this->Frames.Normal(neighbour);
        }
        else if (this->IsUnknown(neighbour))
        {
          this->States[neighbour] = Queued;
          queue.push_back(neighbour);
        }
      }
      const FaceShape shape = ShapeOf(this->Mesh, face);
      const Vector3 x = shape.Sides[shape.Longest].normalized();
      SetFrame(this->Frames, face, x, PerpendicularPart(sum, x));
      this->States[face] = Known;
    }
  }

private:
  enum State : char
  {
    Known,
    Queued,
    Unknown
  };

  /// The face over a halfedge; at the boundary its own.
  int Neighbour(int halfedge) const
  {
    const int twin = this->Mesh.Twin(halfedge);
    return TriangleMesh::FaceOf(twin < 0 ? halfedge : twin);
  }

  const TriangleMesh& Mesh;
  TangentFrames& Frames;
  std::vector<State> States;
};

void FillDegenerateFrames(const TriangleMesh& mesh, const std::vector<int>& degenerate, TangentFrames& frames)
{
  DegenerateFrames filling(mesh, degenerate, frames);
  for (const int face : degenerate)
  {
    if (filling.IsUnknown(face) && filling.TouchesKnown(face))
    {
      filling.FillFrom(face);
    }
  }
  // The remaining faces lie in components that are degenerate as a whole, where any normal will do.
  for (const int face : degenerate)
  {
    if (filling.IsUnknown(face))
    {
      filling.FillFrom(face);
    }
  }
}

}

TangentFrames FaceFrames(const TriangleMesh& mesh, const ExecutionContext& context)
{
  TangentFrames frames = FramesOfSize(mesh.NumberOfFaces());
  std::vector<char> isDegenerate(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const FaceShape shape = ShapeOf(mesh, face);
        isDegenerate[face] = shape.IsDegenerate;
        if (!shape.IsDegenerate)
        {
          SetFrame(frames, face, shape.Sides[0].normalized(), shape.AreaVector.normalized());
        }
      }
    });
  std::vector<int> degenerate;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (isDegenerate[face])
    {
      degenerate.push_back(face);
    }
  }
  if (!degenerate.empty())
  {
    FillDegenerateFrames(mesh, degenerate, frames);
  }
  return frames;
}

std::array<Complex, 3> SideDirections(const TriangleMesh& mesh, const TangentFrames& faceFrames, int face)
{
  const FaceShape shape = ShapeOf(mesh, face);
  if (shape.IsDegenerate)
  {
    return SideDirectionsOfDegenerate(shape);
  }
  std::array<Complex, 3> directions;
  for (int k = 0; k < 3; ++k)
  {
    directions[k] = UnitOf(faceFrames.ToComplex(face, shape.Sides[k]));
  }
  return directions;
}

Unfilled<Complex> SideDirections(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  Unfilled<Complex> sides(3 * mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const std::array<Complex, 3> directions = SideDirections(mesh, faceFrames, face);
        std::copy(directions.begin(), directions.end(), sides.begin() + 3 * face);
      }
    });
  return sides;
}

std::array<Complex, 3> SideDirections(const TriangleMesh& mesh, int face)
{
  const FaceShape shape = ShapeOf(mesh, face);
  if (shape.IsDegenerate)
  {
    return SideDirectionsOfDegenerate(shape);
  }
  // X along the first side; the third is back from the end of the second.
  const double doubledArea = shape.AreaVector.norm();
  const Vector3& x = shape.Sides[0];
  return { Complex(1.0), UnitOf({ x.dot(shape.Sides[1]), doubledArea }),
    UnitOf({ x.dot(shape.Sides[2]), -doubledArea }) };
}

TangentFrames VertexFrames(const TriangleMesh& mesh, const ExecutionContext& context)
{
  Points areaVectors(mesh.NumberOfFaces(), 3);
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        areaVectors.row(face) = mesh.FaceAreaVector(face).transpose();
      }
    });
  TangentFrames frames = FramesOfSize(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int v = first; v < last; ++v)
      {
        Vector3 normal = Vector3::Zero();
        mesh.VisitFan(v, [&](int h) { normal += areaVectors.row(TriangleMesh::FaceOf(h)).transpose(); });
        const int h = mesh.OutgoingHalfedge(v);
        if (normal.squaredNorm() == 0.0)
        {
          const FaceShape shape = ShapeOf(mesh, TriangleMesh::FaceOf(h));
          normal =
            shape.AreaVector.squaredNorm() > 0.0 ? shape.AreaVector : shape.Sides[shape.Longest].unitOrthogonal();
        }
        normal.normalize();
        SetFrame(frames, v, PerpendicularPart(mesh.Position(mesh.Head(h)) - mesh.Position(v), normal), normal);
      }
    });
  return frames;
}

Complex TransportTurn(const TangentFrames& from, int a, const TangentFrames& to, int b)
{
  // The matrix between the frames is a turn about the normal after the shortest rotation between
  // normals; the trace and the skew part of its tangential block are (1 + cos) times cosine and
  // sine of that turn, where cos is that of the angle between the normals.
  const double xx = from.X.row(a).dot(to.X.row(b));
  const double xy = from.X.row(a).dot(to.Y.row(b));
  const double yx = from.Y.row(a).dot(to.X.row(b));
  const double yy = from.Y.row(a).dot(to.Y.row(b));
  const Complex turn(xx + yy, xy - yx);
  const double length = std::sqrt(std::norm(turn));
  // Opposite normals: a half turn about from.X.
  return length < 1e-14 ? Complex(xx, xy) : turn / length;
}

Unfilled<Corner> Corners(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const ExecutionContext& context)
{
  Unfilled<Corner> corners(3 * mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const auto angleAt = [&sides](int h)
        {
          const double angle = std::arg(-sides[TriangleMesh::Previous(h)] * std::conj(sides[h]));
          // Between 0 and pi; rounding may show a straight one as -pi.
          return angle < -0.5 * Pi ? angle + 2.0 * Pi : angle;
        };
        const int h = 3 * face;
        const std::array<double, 2> angles = { angleAt(h), angleAt(h + 1) };
        const double rest = std::max(Pi - angles[0] - angles[1], 0.0);
        for (int k = 0; k < 3; ++k)
        {
          corners[h + k] = { TransportTurn(faceFrames, face, vertexFrames, mesh.Tail(h + k)),
            k < 2 ? angles[k] : rest };
        }
      }
    });
  return corners;
}

}

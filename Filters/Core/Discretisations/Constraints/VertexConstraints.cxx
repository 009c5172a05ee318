#include "Discretisations/Constraints/VertexConstraints.h"

#include "Operators/ConnectionLaplacian.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dmg
{

namespace
{

/// Faces without area hold their corners, too.
constexpr double SmallestShare = 1e-9;

/// The share of a face's area that counts at a corner of it: a third, or half at both ends of a side.
double PartOfCorner(int corner, int side)
{
  if (side < 0)
  {
    return 1.0 / 3.0;
  }
  return corner == (side + 2) % 3 ? 0.0 : 0.5;
}

}

void CheckValue(const ValueConstraint& value, const std::string& name)
{
  if (!std::isfinite(value.Value) || !(value.Weight > 0.0) || !std::isfinite(value.Weight))
  {
    throw InvalidInput("the value " + ShortText(value.Value) + " with the weight " + ShortText(value.Weight) +
      ", prescribed on " + name + ", is not finite or its weight not positive; repair it, or leave the point out, " +
      TextOf(Remedy::MaskOfValues));
  }
}

void CheckSource(const Vector<double>& source, int numberOfVertices, const ElementNames& names)
{
  if (source.size() != numberOfVertices)
  {
    throw InvalidInput("the source has " + std::to_string(source.size()) + " numbers in place of one for each of the " +
      std::to_string(numberOfVertices) + " vertices");
  }
  for (int vertex = 0; vertex < numberOfVertices; ++vertex)
  {
    if (!(std::abs(source[vertex]) <= LargestPrescribed))
    {
      throw InvalidInput("the source is " + ShortText(source[vertex]) + " at " + names.Vertex(vertex) +
        ", which is not finite or too large; repair it");
    }
  }
}

namespace
{

double LengthOf(const TriangleMesh& mesh, int halfedge)
{
  return (mesh.Position(mesh.Head(halfedge)) - mesh.Position(mesh.Tail(halfedge))).norm();
}

/// The sums of constraints along sides, by vertex. The tangent of a curve through three points is the mean of both sides by the inverse of their
/// lengths, although the longer side weighs more.
class TangentsAtVertices
{
public:
  TangentsAtVertices(const TriangleMesh& mesh, const std::vector<Constraint>& onFaces)
    : Mesh(mesh)
    , Sums(mesh.NumberOfVertices())
  {
    for (const Constraint& onFace : onFaces)
    {
      if (onFace.Side >= 0)
      {
        const int h = 3 * onFace.Element + onFace.Side;
        for (const int end : { mesh.Tail(h), mesh.Head(h) })
        {
          this->Sums[end].Longest = std::max(this->Sums[end].Longest, LengthOf(mesh, h));
        }
      }
    }
  }

  void Add(int vertex, int side, double weight, Complex power)
  {
    constexpr double Shortest = 0.1; // the directions of much shorter sides may be noise
    Sum& sum = this->Sums[vertex];
    const double length = std::max(LengthOf(this->Mesh, side), Shortest * sum.Longest);
    const double share = length > 0.0 ? weight / (length * length) : weight;
    sum.Weight += weight;
    sum.Shares += share;
    sum.Power += share * power;
  }

  void AddTo(std::vector<PowerAtVertex>& sums) const
  {
    for (std::size_t vertex = 0; vertex < sums.size(); ++vertex)
    {
      if (const Sum& along = this->Sums[vertex]; along.Weight > 0.0)
      {
        sums[vertex].Add(along.Weight, along.Power / along.Shares);
      }
    }
  }

private:
  struct Sum
  {
    double Longest = 0.0;
    double Weight = 0.0;
    double Shares = 0.0;
    Complex Power = 0.0;
  };

  const TriangleMesh& Mesh;
  std::vector<Sum> Sums;
};

}

std::vector<char> SurroundedVertices(const TriangleMesh& mesh, const std::vector<Constraint>& onFaces)
{
  std::vector<char> isPrescribed(mesh.NumberOfFaces(), 0);
  for (const Constraint& onFace : onFaces)
  {
    CheckElement(onFace.Element, mesh.NumberOfFaces(), "face");
    isPrescribed[onFace.Element] |= onFace.Side == -1;
  }
  std::vector<char> isSurrounded(mesh.NumberOfVertices(), 1);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    isSurrounded[mesh.Tail(h)] &= isPrescribed[TriangleMesh::FaceOf(h)];
  }
  return isSurrounded;
}

std::vector<PowerAtVertex> PowersAtVertices(const FramedMesh& surface, const VertexConnection& connection, int N,
  const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names)
{
  const TriangleMesh& mesh = surface.Mesh;
  const Vector<double> areas = LumpedMass(mesh);
  std::vector<PowerAtVertex> sums(mesh.NumberOfVertices());
  TangentsAtVertices tangents(mesh, constraints.OnFaces);
  for (const Constraint& onFace : constraints.OnFaces)
  {
    const int face = onFace.Element;
    CheckElement(face, mesh.NumberOfFaces(), "face");
    const auto isInside = [&](int k) { return isSurrounded[mesh.FaceCorners()(face, k)] != 0; };
    const bool holdsInside = onFace.Side == -1 && (isInside(0) || isInside(1) || isInside(2));
    const Complex v = TangentialPart(surface.Faces, face, onFace.Direction, onFace.Weight, names.Face(face), "cell");
    const double area = mesh.FaceArea(face);
    for (int k = 0; k < 3; ++k)
    {
      if (const double part = PartOfCorner(k, onFace.Side); part > 0.0 && (isInside(k) || !holdsInside))
      {
        const int h = 3 * face + k;
        const int vertex = mesh.Tail(h);
        const double share = std::max(part * area, SmallestShare * areas[vertex]) / areas[vertex];
        const double weight = onFace.Weight * (areas[vertex] > 0.0 ? share : 1.0);
        const Complex power = PowerOfDirection(connection.TurnFromFace(h) * v, N);
        onFace.Side < 0 ? sums[vertex].Add(weight, power) : tangents.Add(vertex, 3 * face + onFace.Side, weight, power);
      }
    }
  }
  tangents.AddTo(sums);
  for (const Constraint& atVertex : constraints.AtVertices)
  {
    const int vertex = atVertex.Element;
    CheckElement(vertex, mesh.NumberOfVertices(), "vertex");
    const Complex v =
      TangentialPart(surface.Vertices, vertex, atVertex.Direction, atVertex.Weight, names.Vertex(vertex), "point");
    sums[vertex].Add(atVertex.Weight, PowerOfDirection(v, N));
  }
  return sums;
}

}

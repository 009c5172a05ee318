#include "Quads/Crosses/FinerSurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace dmg
{

namespace
{

class Halving
{
public:
  Halving(const TriangleMesh& mesh, Vector<double> longest, double mostFaces)
    : Longest(std::move(longest))
    , MostFaces(mostFaces)
  {
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      this->Positions.push_back(mesh.Position(vertex));
      this->NearVertices.push_back(vertex);
    }
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      this->Faces.push_back({ { mesh.Tail(3 * face), mesh.Tail(3 * face + 1), mesh.Tail(3 * face + 2) }, face,
        Eigen::Matrix3d::Identity() });
      if (IsBackToBack(mesh, face))
      {
        this->Longest[face] = std::numeric_limits<double>::infinity();
      }
    }
  }

  /// Halves the edges that are too long, each once. \return whether there were some.
  bool Halve()
  {
    constexpr double Longer = 1.25;
    std::size_t more = this->FindLongEdges();
    while (more > 0 && static_cast<double>(this->Faces.size() + more) > this->MostFaces)
    {
      this->Longest *= Longer;
      more = this->FindLongEdges();
    }
    std::vector<PartOfFace> parts;
    parts.reserve(this->Faces.size() + more);
    for (const PartOfFace& face : this->Faces)
    {
      this->Divide(face, parts);
    }
    this->Faces = std::move(parts);
    return more > 0;
  }

  std::shared_ptr<const FinerSurface> Result(const ExecutionContext& context) const
  {
    return SurfaceOfParts(this->Positions, this->NearVertices, this->Faces, context);
  }

private:
  /// Whether a face and another one have the same corners. If they were cut, parts in their corners would be the same triangles.
  static bool IsBackToBack(const TriangleMesh& mesh, int face)
  {
    const int other = TriangleMesh::FaceOf(mesh.Twin(3 * face));
    return mesh.Twin(3 * face) >= 0 && other == TriangleMesh::FaceOf(mesh.Twin(3 * face + 1)) &&
      other == TriangleMesh::FaceOf(mesh.Twin(3 * face + 2));
  }

  static std::uint64_t KeyOf(int a, int b)
  {
    const auto [smaller, larger] = std::minmax(a, b);
    return static_cast<std::uint64_t>(smaller) << 32U | static_cast<std::uint32_t>(larger);
  }

  /// \return the number of faces that halving them adds: one for each side of a face.
  std::size_t FindLongEdges()
  {
    this->Middles.clear();
    for (const PartOfFace& face : this->Faces)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int a = face.Vertices[k], b = face.Vertices[(k + 1) % 3];
        if ((this->Positions[a] - this->Positions[b]).norm() > this->Longest[face.Parent])
        {
          this->Middles.emplace(KeyOf(a, b), -1);
        }
      }
    }
    std::size_t sides = 0;
    for (const PartOfFace& face : this->Faces)
    {
      for (int k = 0; k < 3; ++k)
      {
        sides += this->Middles.count(KeyOf(face.Vertices[k], face.Vertices[(k + 1) % 3]));
      }
    }
    return sides;
  }

  /// The vertex in the middle of an edge, -1 where the edge stays.
  int MiddleOf(int a, int b)
  {
    const auto found = this->Middles.find(KeyOf(a, b));
    if (found != this->Middles.end() && found->second < 0)
    {
      found->second = static_cast<int>(this->Positions.size());
      this->Positions.emplace_back(0.5 * (this->Positions[a] + this->Positions[b]));
      this->NearVertices.push_back(this->NearVertices[std::min(a, b)]);
    }
    return found == this->Middles.end() ? -1 : found->second;
  }

  void Divide(const PartOfFace& face, std::vector<PartOfFace>& parts)
  {
    // Points 0 to 2 are the corners, 3 to 5 the middles of the sides after them.
    std::array<int, 6> points{};
    std::array<Vector3, 6> places;
    int halved = 0, first = 0; // the first of the halved sides, where one or two are
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      points[k] = face.Vertices[k];
      points[3 + k] = this->MiddleOf(face.Vertices[k], face.Vertices[next]);
      places[k] = face.Corners.col(k);
      places[3 + k] = 0.5 * (face.Corners.col(k) + face.Corners.col(next));
      halved += points[3 + k] >= 0 ? 1 : 0;
    }
    while (halved % 3 != 0 && !(points[3 + first] >= 0 && points[3 + (first + 2) % 3] < 0))
    {
      ++first;
    }
    const auto at = [first](int k) { return k < 3 ? (k + first) % 3 : 3 + (k + first) % 3; };
    const auto add = [&](int a, int b, int c)
    {
      PartOfFace part{ { points[at(a)], points[at(b)], points[at(c)] }, face.Parent, {} };
      part.Corners << places[at(a)], places[at(b)], places[at(c)];
      parts.push_back(part);
    };
    if (halved == 0)
    {
      parts.push_back(face);
    }
    else if (halved == 1)
    {
      add(0, 3, 2);
      add(3, 1, 2);
    }
    else if (halved == 2)
    {
      add(3, 1, 4);
      const auto length = [&](int a, int b)
      { return (this->Positions[points[at(a)]] - this->Positions[points[at(b)]]).norm(); };
      const bool isFirst = length(0, 4) <= length(3, 2);
      add(0, 3, isFirst ? 4 : 2);
      add(isFirst ? 0 : 3, 4, 2);
    }
    else
    {
      add(0, 3, 5);
      add(3, 1, 4);
      add(5, 4, 2);
      add(3, 4, 5);
    }
  }

  std::vector<Vector3> Positions;
  std::vector<int> NearVertices;
  std::vector<PartOfFace> Faces;
  Vector<double> Longest;
  const double MostFaces;
  std::unordered_map<std::uint64_t, int> Middles; ///< of long edges, -1 before there is one
};

/// The fourth power of a direction on a face, in the frame of another one in the same plane.
Complex Carried(Complex power, const FramedMesh& from, int face, const FramedMesh& to, int other)
{
  const Vector3 direction = from.Faces.ToVector(face, std::polar(1.0, 0.25 * std::arg(power)));
  return std::polar(std::abs(power), 4.0 * std::arg(to.Faces.ToComplex(other, direction)));
}

}

SurfacePlace FinerSurface::InParent(const SurfacePlace& place) const
{
  return { this->Parents[place.Face], this->Corners[place.Face] * place.Weights };
}

int FinerSurface::HalfedgeOfParent(int halfedge) const
{
  const int face = TriangleMesh::FaceOf(halfedge);
  const Eigen::Vector3d sum = this->Corners[face].col(halfedge % 3) + this->Corners[face].col((halfedge + 1) % 3);
  for (int opposite = 0; opposite < 3; ++opposite)
  {
    if (sum[opposite] == 0.0)
    {
      return 3 * this->Parents[face] + (opposite + 1) % 3;
    }
  }
  return -1;
}

Vector<Complex> FinerSurface::PowersOf(const FramedMesh& surface, const Vector<Complex>& powers) const
{
  Vector<Complex> finer(this->Geometry.Mesh.NumberOfFaces());
  for (int face = 0; face < finer.size(); ++face)
  {
    finer[face] = Carried(powers[this->Parents[face]], surface, this->Parents[face], this->Geometry, face);
  }
  return finer;
}

Vector<Complex> FinerSurface::PowersOfParents(const FramedMesh& surface, const Vector<Complex>& powers) const
{
  Vector<Complex> ofParents(surface.Mesh.NumberOfFaces());
  for (int face = static_cast<int>(this->Parents.size()) - 1; face >= 0; --face)
  {
    ofParents[this->Parents[face]] = Carried(powers[face], this->Geometry, face, surface, this->Parents[face]);
  }
  return ofParents;
}

ElementNames FinerSurface::NamesOf(const ElementNames& names) const
{
  ElementNames finer;
  for (const int vertex : this->NearVertices)
  {
    finer.Vertices.push_back(names.Vertices.empty() ? vertex : names.Vertices[vertex]);
  }
  for (const int parent : this->Parents)
  {
    finer.Faces.push_back(names.Faces.empty() ? parent : names.Faces[parent]);
  }
  return finer;
}

std::shared_ptr<const FinerSurface> SurfaceOfParts(const std::vector<Vector3>& positions, std::vector<int> nearVertices,
  const std::vector<PartOfFace>& parts, const ExecutionContext& context)
{
  Points points(static_cast<int>(positions.size()), 3);
  for (int vertex = 0; vertex < points.rows(); ++vertex)
  {
    points.row(vertex) = positions[vertex].transpose();
  }
  Triangles triangles(static_cast<int>(parts.size()), 3);
  std::vector<int> parents;
  std::vector<Eigen::Matrix3d> corners;
  for (int face = 0; face < triangles.rows(); ++face)
  {
    const PartOfFace& part = parts[face];
    triangles.row(face) << part.Vertices[0], part.Vertices[1], part.Vertices[2];
    parents.push_back(part.Parent);
    corners.push_back(part.Corners);
  }
  return std::make_shared<FinerSurface>(
    FinerSurface{ FramedMesh(TriangleMesh(std::move(points), std::move(triangles), {}, context), context),
      std::move(parents), std::move(corners), std::move(nearVertices) });
}

std::shared_ptr<const FinerSurface> HalveLongEdges(
  const FramedMesh& surface, const Vector<double>& longest, double mostFaces, const ExecutionContext& context)
{
  context.Checkpoint(0.0);
  Halving halving(surface.Mesh, longest, mostFaces);
  if (!halving.Halve())
  {
    return nullptr;
  }
  do
  {
    context.Checkpoint(0.0);
  } while (halving.Halve());
  return halving.Result(context);
}

}

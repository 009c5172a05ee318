#include "Quads/Isolines/SplitTriangles.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace dmg
{

namespace
{

/// Quads in triangles, whose vertices stay where they are.
class SplitQuads
{
public:
  SplitQuads(const TriangleMesh& mesh, IndexedQuads& quads, CellPlaces& places)
    : Mesh(mesh)
    , Quads(quads)
    , Places(places)
  {
  }

  /// Three quads for each face that is marked.
  void SplitFaces(const std::vector<char>& isMarked)
  {
    std::vector<int> ofVertices(this->Mesh.NumberOfVertices(), -1), ofEdges(this->Mesh.NumberOfEdges(), -1);
    const auto once = [this](int& number, const SurfacePlace& place, bool isOnBoundary)
    { return number < 0 ? number = this->Add(place, isOnBoundary) : number; };
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      if (!isMarked[face])
      {
        continue;
      }
      std::array<int, 3> corners{}, middles{};
      for (int k = 0; k < 3; ++k)
      {
        const int h = 3 * face + k, vertex = this->Mesh.Tail(h);
        corners[k] = once(ofVertices[vertex], AtTail(h), this->Mesh.IsBoundaryVertex(vertex));
        middles[k] = once(ofEdges[this->Mesh.EdgeOf(h)], OnHalfedge(h, 0.5), this->Mesh.Twin(h) < 0);
      }
      const int centre = this->Add({ face, Vector3::Constant(1.0 / 3.0) }, false);
      for (int k = 0; k < 3; ++k)
      {
        this->Quads.Corners.push_back({ corners[k], middles[k], centre, middles[(k + 2) % 3] });
        this->Quads.Faces.push_back(face);
      }
    }
  }

  /// Four quads for each one from a first one on.
  void SplitEach(int first)
  {
    std::map<std::pair<int, int>, int> middles;
    const std::vector<std::array<int, 4>> before(this->Quads.Corners.begin() + first, this->Quads.Corners.end());
    const std::vector<int> faces(this->Quads.Faces.begin() + first, this->Quads.Faces.end());
    this->Quads.Corners.resize(first);
    this->Quads.Faces.resize(first);
    for (std::size_t q = 0; q < before.size(); ++q)
    {
      const std::array<int, 4>& corners = before[q];
      const auto position = [&](int k) { return PositionOf(this->Mesh, this->Places.Places[corners[k % 4]]); };
      std::array<int, 4> sides{};
      for (int k = 0; k < 4; ++k)
      {
        const auto [middle, isNew] = middles.emplace(std::minmax(corners[k], corners[(k + 1) % 4]), -1);
        if (isNew)
        {
          middle->second = this->Add(PlaceInFace(this->Mesh, faces[q], 0.5 * (position(k) + position(k + 1))), true);
        }
        else
        {
          this->Quads.IsOnBoundary[middle->second] = 0; // there is a quad on the other side
        }
        sides[k] = middle->second;
      }
      const int centre = this->Add(
        PlaceInFace(this->Mesh, faces[q], 0.25 * (position(0) + position(1) + position(2) + position(3))), false);
      for (int k = 0; k < 4; ++k)
      {
        this->Quads.Corners.push_back({ corners[k], sides[k], centre, sides[(k + 3) % 4] });
        this->Quads.Faces.push_back(faces[q]);
      }
    }
  }

private:
  int Add(const SurfacePlace& place, bool isOnBoundary)
  {
    this->Places.Places.push_back(place);
    this->Places.Holds.push_back(Hold::AtPoint);
    this->Places.Singularities.push_back(0);
    this->Quads.IsOnBoundary.push_back(isOnBoundary);
    return this->Quads.NumberOfVertices() - 1;
  }

  const TriangleMesh& Mesh;
  IndexedQuads& Quads;
  CellPlaces& Places;
};

void Remove(const std::vector<int>& components, const std::vector<double>& wanted, IndexedQuads& quads)
{
  int kept = 0;
  for (int quad = 0; quad < quads.Size(); ++quad)
  {
    if (wanted[components[quads.Faces[quad]]] == 0.0)
    {
      quads.Corners[kept] = quads.Corners[quad];
      quads.Faces[kept++] = quads.Faces[quad];
    }
  }
  quads.Corners.resize(kept);
  quads.Faces.resize(kept);
}

}

int SplitTriangles(const TriangleMesh& mesh, const std::vector<int>& components, const std::vector<double>& wanted,
  IndexedQuads& quads, CellPlaces& places)
{
  Remove(components, wanted, quads);
  int triangles = 0;
  for (int component = 0; component < static_cast<int>(wanted.size()); ++component)
  {
    if (wanted[component] <= 0.0)
    {
      continue;
    }
    std::vector<char> isIn(mesh.NumberOfFaces());
    std::transform(
      components.begin(), components.end(), isIn.begin(), [component](int ofFace) { return ofFace == component; });
    triangles += static_cast<int>(std::count(isIn.begin(), isIn.end(), 1));
    const int first = quads.Size();
    SplitQuads split(mesh, quads, places);
    split.SplitFaces(isIn);
    while (2.0 * (quads.Size() - first) < wanted[component])
    {
      split.SplitEach(first);
    }
  }
  return triangles;
}

}

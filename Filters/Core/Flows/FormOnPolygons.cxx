#include "Flows/FormOnPolygons.h"

#include <algorithm>

namespace dmg
{
namespace
{

/// A polygon with its diagonals.
class Polygon
{
public:
  Polygon(const TriangleMesh& mesh, const ElementRow& faces, Vector<double>& form, std::vector<char>& isKnown)
    : Mesh(mesh)
    , Faces(faces)
    , Form(form)
    , IsKnown(isKnown)
  {
  }

  /// The triangles of a polygon and its diagonals are a tree: there is always a triangle with one unknown side.
  void Fill()
  {
    const double density = this->Density();
    for (bool isChanged = true; isChanged;)
    {
      isChanged = false;
      for (const int face : this->Faces)
      {
        isChanged |= this->FillFrom(face, density);
      }
    }
  }

private:
  double Along(int halfedge) const
  {
    const int edge = this->Mesh.EdgeOf(halfedge);
    return this->IsKnown[edge] ? this->Mesh.EdgeSign(halfedge) * this->Form[edge] : 0.0;
  }

  /// The curl of a face, as far as its sides are known.
  double KnownCurl(int face) const
  {
    return this->Along(3 * face) + this->Along(3 * face + 1) + this->Along(3 * face + 2);
  }

  double Density() const
  {
    double curl = 0.0;
    double area = 0.0;
    for (const int face : this->Faces)
    {
      curl += this->KnownCurl(face); // that of diagonals cancels
      area += this->Mesh.FaceArea(face);
    }
    return area > 0.0 ? curl / area : 0.0;
  }

  /// \return whether it was possible.
  bool FillFrom(int face, double density)
  {
    int unknown = -1;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      if (!this->IsKnown[this->Mesh.EdgeOf(h)])
      {
        if (unknown >= 0)
        {
          return false;
        }
        unknown = h;
      }
    }
    if (unknown < 0 || this->Mesh.Twin(unknown) < 0)
    {
      return false;
    }
    const double rest = density * this->Mesh.FaceArea(face) - this->KnownCurl(face);
    this->Form[this->Mesh.EdgeOf(unknown)] = this->Mesh.EdgeSign(unknown) * rest;
    this->IsKnown[this->Mesh.EdgeOf(unknown)] = 1;
    return true;
  }

  const TriangleMesh& Mesh;
  const ElementRow Faces;
  Vector<double>& Form;
  std::vector<char>& IsKnown;
};

/// Whether an edge lies between two faces of one cell.
bool IsDiagonal(const TriangleMesh& mesh, const SurfaceRelation& surface, int edge)
{
  const int h = mesh.HalfedgeOf(edge);
  const int twin = mesh.Twin(h);
  return twin >= 0 && surface.CellOf(TriangleMesh::FaceOf(h)) == surface.CellOf(TriangleMesh::FaceOf(twin));
}

}

int FillDiagonals(
  const TriangleMesh& mesh, const SurfaceRelation& surface, Vector<double>& form, std::vector<char>& isKnown)
{
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (!isKnown[edge] && !IsDiagonal(mesh, surface, edge))
    {
      return edge;
    }
  }
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (!isKnown[edge])
    {
      const int face = TriangleMesh::FaceOf(mesh.HalfedgeOf(edge));
      Polygon(mesh, surface.FacesOf(surface.CellOf(face)), form, isKnown).Fill();
    }
  }
  const auto unknown = std::find(isKnown.begin(), isKnown.end(), 0);
  return unknown == isKnown.end() ? -1 : static_cast<int>(unknown - isKnown.begin());
}

}

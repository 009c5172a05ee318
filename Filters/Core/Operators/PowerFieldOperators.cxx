#include "Operators/PowerFieldOperators.h"

#include "Support/Permutations.h"
#include "Support/SparseAssembly.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

/// Keeps |e|^2 / area of slivers finite; relative to |e|^2.
constexpr double SmallestArea = 1e-6;

/// The same number for both halfedges of an edge.
double WeightOfEdge(double squaredLength, double areaOfBothFaces)
{
  return squaredLength > 0.0 ? 3.0 * squaredLength / std::max(areaOfBothFaces, SmallestArea * squaredLength) : 0.0;
}

double SquaredLength(const TriangleMesh& mesh, int halfedge)
{
  return (mesh.Position(mesh.Head(halfedge)) - mesh.Position(mesh.Tail(halfedge))).squaredNorm();
}

/// The shape of a face as the Laplacian needs it, and the places of its neighbours.
struct PowerFaceShape
{
  std::array<Complex, 3> Sides;
  std::array<double, 3> SquaredLengths;
  double Area;
  std::array<int, 3> Twins; ///< 3 * place of the neighbour + its side; -1 where there is none
};

std::array<int, 3> TwinsOf(const TriangleMesh& mesh, const std::vector<int>& places, int face)
{
  std::array<int, 3> twins;
  for (int k = 0; k < 3; ++k)
  {
    const int twin = mesh.Twin(3 * face + k);
    twins[k] = twin >= 0 ? 3 * places[TriangleMesh::FaceOf(twin)] + twin % 3 : -1;
  }
  return twins;
}

PowerFaceShape ShapeOf(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const std::vector<int>& places, int face)
{
  PowerFaceShape shape{ SideDirections(mesh, faceFrames, face), {}, mesh.FaceArea(face), TwinsOf(mesh, places, face) };
  for (int k = 0; k < 3; ++k)
  {
    shape.SquaredLengths[k] = SquaredLength(mesh, 3 * face + k);
  }
  return shape;
}

/// The places of a face and its neighbours, ascending, each once.
struct FaceAndNeighbours
{
  FaceAndNeighbours(int place, const std::array<int, 3>& twins)
  {
    this->Insert(place);
    for (const int twin : twins)
    {
      if (twin >= 0 && this->Find(twin / 3) == this->Count)
      {
        this->Insert(twin / 3);
      }
    }
  }

  /// Count if it is none of them.
  int Find(int place) const
  {
    int k = 0;
    while (k < this->Count && this->Places[k] != place)
    {
      ++k;
    }
    return k;
  }

  std::array<int, 4> Places;
  int Count = 0;

private:
  void Insert(int place)
  {
    int k = this->Count++;
    for (; k > 0 && this->Places[k - 1] > place; --k)
    {
      this->Places[k] = this->Places[k - 1];
    }
    this->Places[k] = place;
  }
};

}

double PowerEdgeWeight(const TriangleMesh& mesh, int halfedge)
{
  const int twin = mesh.Twin(halfedge);
  const auto area = [&mesh](int h) { return mesh.FaceArea(TriangleMesh::FaceOf(h)); };
  return twin >= 0 ? WeightOfEdge(SquaredLength(mesh, halfedge), area(halfedge) + area(twin)) : 0.0;
}

SparseMatrix<Complex> PowerLaplacian(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, int N, const ExecutionContext& context)
{
  return PowerLaplacian(mesh, faceFrames, N, Identity(mesh.NumberOfFaces()), context);
}

SparseMatrix<Complex> PowerLaplacian(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const std::vector<int>& order, const ExecutionContext& context)
{
  const std::vector<int> places = Inverse(order, context);
  const int faces = mesh.NumberOfFaces();
  SparseMatrix<Complex> L(faces, faces);
  MakeRoom(L, context, [&](int place) { return FaceAndNeighbours(place, TwinsOf(mesh, places, order[place])).Count; });
  const auto fillRow = [&L, N](int place, const PowerFaceShape& here, const auto& shapeAt)
  {
    const FaceAndNeighbours around(place, here.Twins);
    Complex* const entries = L.valuePtr() + L.outerIndexPtr()[place];
    std::copy_n(around.Places.begin(), around.Count, L.innerIndexPtr() + L.outerIndexPtr()[place]);
    std::fill_n(entries, around.Count, Complex(0.0));
    for (int k = 0; k < 3; ++k)
    {
      const int twin = here.Twins[k];
      if (twin < 0)
      {
        continue;
      }
      const PowerFaceShape& there = shapeAt(twin / 3);
      const double weight = WeightOfEdge(here.SquaredLengths[k], here.Area + there.Area);
      // Two faces may meet along two edges, whose entries add up.
      entries[around.Find(place)] += weight;
      entries[around.Find(twin / 3)] -= weight * Power(TransportOfSides(there.Sides[twin % 3], here.Sides[k]), N);
    }
  };
  // Neighbours stand near each other. So most shapes are found once, and none is held for long.
  constexpr int bandSize = 2048;
  context.ParallelFor(0, (faces + bandSize - 1) / bandSize, 1,
    [&](int firstBand, int lastBand)
    {
      const auto shapeOf = [&](int place) { return ShapeOf(mesh, faceFrames, places, order[place]); };
      std::vector<PowerFaceShape> shapes;
      for (int band = firstBand; band < lastBand; ++band)
      {
        const int first = band * bandSize;
        const int last = std::min(first + bandSize, faces);
        shapes.clear();
        for (int place = first; place < last; ++place)
        {
          shapes.push_back(shapeOf(place));
        }
        PowerFaceShape elsewhere;
        const auto shapeAt = [&](int place) -> const PowerFaceShape&
        { return first <= place && place < last ? shapes[place - first] : elsewhere = shapeOf(place); };
        for (int place = first; place < last; ++place)
        {
          fillRow(place, shapes[place - first], shapeAt);
        }
      }
    });
  return L;
}

}

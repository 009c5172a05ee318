#ifndef dmgTestSurfaceInPieces_h
#define dmgTestSurfaceInPieces_h

#include "SolverTools.h"

#include "vtkIdTypeArray.h"
#include "vtkMultiProcessController.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <map>

/// A surface of which each rank has a band, and fields of the whole to compare with.
namespace dmg::test
{

inline int Rank()
{
  return vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
}

inline int Ranks()
{
  return vtkMultiProcessController::GetGlobalController()->GetNumberOfProcesses();
}

/// Whether all ranks say so.
inline bool OnAll(bool here)
{
  const int value = here ? 1 : 0;
  int least = 0;
  vtkMultiProcessController::GetGlobalController()->AllReduce(&value, &least, 1, vtkCommunicator::MIN_OP);
  return least == 1;
}

inline int Sum(int here)
{
  int sum = 0;
  vtkMultiProcessController::GetGlobalController()->AllReduce(&here, &sum, 1, vtkCommunicator::SUM_OP);
  return sum;
}

/// The band of a sphere in which a triangle's centre is, from bottom to top.
inline int BandOf(const Surface& surface, int triangle, int bands)
{
  double z = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    z += surface.V(surface.F(triangle, k), 2) / 3.0;
  }
  return std::clamp(static_cast<int>(0.5 * (z + 1.0) * bands), 0, bands - 1);
}

/// Cuts out the given triangles of Sphere(subdivisions), with their points alone and with the directions Given.
template <class IsTaken>
vtkSmartPointer<vtkPolyData> PieceOfSphere(int subdivisions, const IsTaken& isTaken)
{
  const Surface whole = Icosphere(subdivisions);
  const auto given = Sphere(subdivisions);
  std::map<int, vtkIdType> numbers;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkDoubleArray> directions;
  directions->SetName("Given");
  directions->SetNumberOfComponents(3);
  for (int f = 0; f < whole.F.rows(); ++f)
  {
    if (!isTaken(whole, f))
    {
      continue;
    }
    triangles->InsertNextCell(3);
    for (int k = 0; k < 3; ++k)
    {
      const int point = whole.F(f, k);
      const auto [place, isNew] = numbers.emplace(point, points->GetNumberOfPoints());
      if (isNew)
      {
        points->InsertNextPoint(whole.V(point, 0), whole.V(point, 1), whole.V(point, 2));
      }
      triangles->InsertCellPoint(place->second);
    }
    directions->InsertNextTuple(given->GetCellData()->GetArray("Given")->GetTuple(f));
  }
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->SetPoints(points);
  piece->SetPolys(triangles);
  piece->GetCellData()->AddArray(directions);
  return piece;
}

inline constexpr int Subdivisions = 3;

/// The band of this rank, of as many as ranks.
inline vtkSmartPointer<vtkPolyData> OwnBand(int bands = Ranks(), int first = 0)
{
  return PieceOfSphere(
    Subdivisions, [bands, first](const Surface& whole, int f) { return BandOf(whole, f, bands) == Rank() - first; });
}

/// Asks for the piece of this rank, as ParaView does.
inline void UpdateOwnPiece(vtkAlgorithm* filter)
{
  filter->UpdatePiece(Rank(), Ranks(), 0);
}

inline std::string Gathered(vtkDataObject* output)
{
  auto* const text = vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray("Gathered"));
  return text ? text->GetValue(0) : std::string();
}

using Place = std::array<double, 3>;

/// The directions of a field of four at each point, by place.
inline std::map<Place, std::array<Vector3, 4>> DirectionsAtPoints(vtkDataSet* field)
{
  std::map<Place, std::array<Vector3, 4>> directions;
  for (vtkIdType point = 0; point < field->GetNumberOfPoints(); ++point)
  {
    Place place;
    field->GetPoint(point, place.data());
    for (int k = 0; k < 4; ++k)
    {
      directions[place][k] = Tuple(field->GetPointData(), "Direction" + std::to_string(k), point);
    }
  }
  return directions;
}

/// The largest distance of the first direction at a point to the next of the other field there, over the points of \p field.
inline double LargestDifference(vtkDataSet* field, vtkDataSet* other)
{
  const auto expected = DirectionsAtPoints(other);
  double largest = 0.0;
  for (const auto& [place, directions] : DirectionsAtPoints(field))
  {
    const auto found = expected.find(place);
    if (found == expected.end())
    {
      return std::numeric_limits<double>::infinity();
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3& direction : found->second)
    {
      least = std::min(least, (direction - directions[0]).norm());
    }
    largest = std::max(largest, least);
  }
  return largest;
}

/// The field on the whole sphere, by this process alone.
inline vtkSmartPointer<vtkDataSet> FieldOfWhole()
{
  const auto solver = NewSolver(Sphere(Subdivisions));
  solver->Update(); // piece 0 of 1
  return vtkDataSet::SafeDownCast(solver->GetOutput());
}

}

#endif

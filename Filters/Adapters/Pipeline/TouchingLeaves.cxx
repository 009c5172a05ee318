#include "Adapters/Pipeline/TouchingLeaves.h"

#include "Adapters/Ranks/NearPlaces.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkFeatureEdges.h"
#include "vtkGeometryFilter.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

/// The points on the boundary of a surface.
struct Boundary
{
  std::vector<NearPlaces::Place> Places;
  vtkBoundingBox Box;
};

/// The boundaries of the leaves that a filter has seen in an execution, kept by the filter.
class FormerLeaves : public vtkObject
{
public:
  static FormerLeaves* New();
  vtkTypeMacro(FormerLeaves, vtkObject);

  std::vector<Boundary> Boundaries;
  bool ComesNext = false; ///< a leaf that was not looked at
  bool IsTold = false;
};

vtkStandardNewMacro(FormerLeaves);

vtkInformationObjectBaseKey* Key()
{
  static vtkInformationObjectBaseKey* const key =
    vtkInformationObjectBaseKey::MakeKey("FORMER_LEAVES", "DirectionalMultigrid");
  return key;
}

FormerLeaves* LeavesOf(vtkAlgorithm* algorithm)
{
  return FormerLeaves::SafeDownCast(algorithm->GetInformation()->Get(Key()));
}

/// The cells of two dimensions, without arrays.
vtkSmartPointer<vtkPolyData> Bare(vtkDataSet* surface)
{
  const auto copy = vtk::TakeSmartPointer(surface->NewInstance());
  copy->CopyStructure(surface);
  if (auto* const polyData = vtkPolyData::SafeDownCast(copy))
  {
    return { polyData };
  }
  vtkNew<vtkGeometryFilter> filter;
  filter->SetInputData(copy);
  filter->Update();
  return { filter->GetOutput() };
}

Boundary BoundaryOf(vtkDataSet* surface)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(Bare(surface));
  edges->BoundaryEdgesOn();
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  vtkPolyData* const lines = edges->GetOutput();
  Boundary boundary{ std::vector<NearPlaces::Place>(lines->GetNumberOfPoints()), {} };
  for (vtkIdType point = 0; point < lines->GetNumberOfPoints(); ++point)
  {
    lines->GetPoint(point, boundary.Places[point].data());
    boundary.Box.AddPoint(boundary.Places[point].data());
  }
  return boundary;
}

/// Whether two points at least of both boundaries are at the same places.
bool TouchesAny(const std::vector<Boundary>& former, const Boundary& boundary)
{
  const double rounding = NearPlaces::Rounding(boundary.Places);
  const NearPlaces near(boundary.Places, rounding);
  vtkBoundingBox around = boundary.Box;
  around.Inflate(rounding);
  return std::any_of(former.begin(), former.end(),
    [&](const Boundary& other)
    {
      const auto coincides = [&](const NearPlaces::Place& place)
      { return around.ContainsPoint(place.data()) != 0 && near.First(place) >= 0; };
      return other.Box != boundary.Box && other.Box.Intersects(around) != 0 &&
        std::count_if(other.Places.begin(), other.Places.end(), coincides) > 1;
    });
}

}

void BeginExecution(vtkAlgorithm* algorithm, bool isLeaf)
{
  vtkInformation* const information = algorithm->GetInformation();
  if (!isLeaf)
  {
    information->Remove(Key());
    return;
  }
  if (!LeavesOf(algorithm))
  {
    information->Set(Key(), vtkNew<FormerLeaves>());
  }
  LeavesOf(algorithm)->ComesNext = true;
}

bool IsOnLeaf(vtkAlgorithm* algorithm)
{
  return LeavesOf(algorithm) != nullptr;
}

void WarnOfTouchingLeaves(vtkAlgorithm* algorithm, vtkDataSet* surface)
{
  FormerLeaves* const leaves = LeavesOf(algorithm);
  if (!leaves || !leaves->ComesNext || leaves->IsTold)
  {
    return;
  }
  leaves->ComesNext = false;
  Boundary boundary = BoundaryOf(surface);
  if (boundary.Places.empty())
  {
    return;
  }
  leaves->IsTold = TouchesAny(leaves->Boundaries, boundary);
  if (leaves->IsTold)
  {
    vtkWarningWithObjectMacro(algorithm,
      "boundaries of blocks lie on each other, and each block is worked on by itself; to have one surface, apply Merge "
      "Blocks (vtkAppendFilter) first");
  }
  leaves->Boundaries.push_back(std::move(boundary));
}

}

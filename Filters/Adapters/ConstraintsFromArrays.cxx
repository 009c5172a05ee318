#include "Adapters/ConstraintsFromArrays.h"

#include "Support/Errors.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <sstream>

namespace dmg
{

namespace
{

/// A direction leaning less than this (as a sine) out of the normal has no tangential part.
constexpr double SmallestTangentialPart = 1e-6;

PrescribedDirections DirectionsOnSurface(const ConstraintArrays& arrays, const SurfaceMesh& surface)
{
  PrescribedDirections directions;
  if (arrays.OnPoints)
  {
    VisitPrescribed(
      arrays, [&surface](vtkIdType point) { return surface.VertexOf(point) >= 0; },
      [&directions, &surface](const ElementDirection& given)
      {
        directions.AtVertices.push_back(
          { surface.VertexOf(given.Element), given.Vector, given.Weight });
      });
  }
  else
  {
    VisitPrescribed(
      arrays, [&surface](vtkIdType cell) { return surface.FaceOf(cell) >= 0; },
      [&directions, &surface](const ElementDirection& given) {
        directions.OnFaces.push_back({ surface.FaceOf(given.Element), given.Vector, given.Weight });
      });
  }
  return directions;
}

/// A dataset of the second input.
struct SourceDataSet
{
  vtkDataSet* Data;
  std::string Name; ///< for messages
};

/// \throw InvalidInput \p source is neither a dataset nor made of some.
std::vector<SourceDataSet> DataSetsOf(vtkDataObject* source)
{
  const std::string name = "the second input";
  std::vector<SourceDataSet> datasets;
  if (auto* const dataset = vtkDataSet::SafeDownCast(source))
  {
    datasets.push_back({ dataset, name });
  }
  else if (auto* const composite = vtkCompositeDataSet::SafeDownCast(source))
  {
    const auto leaves = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      if (auto* const leaf = vtkDataSet::SafeDownCast(leaves->GetCurrentDataObject()))
      {
        datasets.push_back(
          { leaf, "block " + std::to_string(leaves->GetCurrentFlatIndex()) + " of " + name });
      }
    }
  }
  else if (source)
  {
    throw InvalidInput(name + " is a " + source->GetClassName() +
      ", which is no dataset; connect points with vectors, as Table To Points "
      "(vtkTableToPolyData) makes of a table");
  }
  const auto isEmpty = [](const SourceDataSet& source)
  { return source.Data->GetNumberOfPoints() == 0; };
  datasets.erase(std::remove_if(datasets.begin(), datasets.end(), isEmpty), datasets.end());
  return datasets;
}

/// The arrays of all datasets; those without the chosen vectors take no part if another has them.
std::vector<ConstraintArrays> ArraysOfSource(
  const ConstraintChoices& choices, const std::vector<SourceDataSet>& datasets)
{
  const auto hasVectors = [&choices](const SourceDataSet& source)
  { return HasArray(choices.Vectors, source.Data); };
  const bool onlyWithVectors = std::any_of(datasets.begin(), datasets.end(), hasVectors);
  std::vector<ConstraintArrays> arrays;
  for (const SourceDataSet& source : datasets)
  {
    if (!onlyWithVectors || hasVectors(source))
    {
      arrays.push_back(
        FindArrays(choices, source.Data, source.Data->GetPointData()->GetVectors(), source.Name));
    }
    else
    {
      arrays.emplace_back();
    }
  }
  return arrays;
}

/// Finds the face of a surface that is nearest to a point.
class NearestFaces
{
public:
  NearestFaces(vtkPolyData* surface, const SurfaceMesh& mesh)
    : Mesh(mesh)
  {
    vtkNew<vtkPolyData> triangles; // its cells are the polygons
    triangles->SetPoints(surface->GetPoints());
    triangles->SetPolys(surface->GetPolys());
    this->Locator->SetDataSet(triangles);
    this->Locator->BuildLocator();
  }

  /// \param name of the point, for the message.
  /// \throw InvalidInput the point is not finite, or too far away for its distance to be a number.
  int operator()(const Vector3& position, const std::string& name)
  {
    // The locator asserts what is checked here.
    const double scale = position.squaredNorm();
    vtkIdType polygon = -1;
    if (std::isfinite(scale))
    {
      double closest[3], squaredDistance;
      int subId;
      this->Locator->FindClosestPoint(
        position.data(), closest, this->Cell, polygon, subId, squaredDistance);
    }
    if (polygon < 0)
    {
      std::ostringstream message;
      message << name << " lies at (" << position.x() << ", " << position.y() << ", "
              << position.z() << "), which has no nearest triangle; move the point, remove it, or "
              << "make its direction zero";
      throw InvalidInput(message.str());
    }
    return this->Mesh.Faces[polygon];
  }

private:
  const SurfaceMesh& Mesh;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

void AddDirectionsFromPoints(const ConstraintArrays& arrays, vtkDataSet* points,
  const FramedSurface& framed, NearestFaces& nearest, std::vector<PrescribedDirection>& directions)
{
  if (arrays.Vectors && !arrays.OnPoints)
  {
    throw InvalidInput(std::string("array '") + arrays.Vectors->GetName() +
      "' prescribes directions on cells of " + arrays.Whose +
      "; convert it with Cell Data To Point Data (vtkCellDataToPointData), or choose a point "
      "array");
  }
  VisitPrescribed(
    arrays, [](vtkIdType) { return true; },
    [&](const ElementDirection& given)
    {
      Vector3 position;
      points->GetPoint(given.Element, position.data());
      const int face = nearest(position, arrays.NameOf(given.Element));
      const Complex direction = framed.Faces.ToComplex(face, given.Vector);
      if (std::abs(direction) <= SmallestTangentialPart * given.Vector.norm())
      {
        throw InvalidInput("the direction prescribed at " + arrays.NameOf(given.Element) +
          " is perpendicular to the nearest triangle, cell " +
          std::to_string(framed.Surface.CellOf(face)) + "; turn it or make it zero");
      }
      directions.push_back({ face, given.Vector, given.Weight });
    });
}

}

PrescribedDirections ChosenDirections(const ConstraintChoices& onSurface, vtkPolyData* surface,
  const ConstraintChoices& onSource, vtkDataObject* source, const FramedSurface& framed)
{
  PrescribedDirections directions =
    DirectionsOnSurface(FindArrays(onSurface, surface, nullptr, "the surface"), framed.Surface);
  const std::vector<SourceDataSet> datasets = DataSetsOf(source);
  const std::vector<ConstraintArrays> arrays = ArraysOfSource(onSource, datasets);
  if (!datasets.empty())
  {
    NearestFaces nearest(surface, framed.Surface);
    for (std::size_t i = 0; i < datasets.size(); ++i)
    {
      AddDirectionsFromPoints(arrays[i], datasets[i].Data, framed, nearest, directions.OnFaces);
    }
  }
  if (directions.OnFaces.empty() && directions.AtVertices.empty())
  {
    throw InvalidInput("no direction is prescribed; choose an array of vectors for Directions, on "
                       "the surface, or for Source Directions, on the second input, and a Mask, if "
                       "any, that is not zero everywhere");
  }
  return directions;
}

}

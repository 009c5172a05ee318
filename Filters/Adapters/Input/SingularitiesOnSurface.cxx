#include "Adapters/Input/SingularitiesOnSurface.h"

#include "Adapters/Input/GuideDataSets.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <limits>
#include <map>

namespace dmg
{

namespace
{

// The names that vtkFieldSingularities gives them.
constexpr const char* NameOfIndices = "Index";
constexpr const char* NamesOfIds[] = { "PointId", "CellId" };

/// A point, or several that are one singularity, as those of a sphere around it.
struct GivenSingularity
{
  vtkIdType FirstPoint;
  int NumberOfPoints;
  Vector3 Sum; ///< of their positions
};

/// Points with the same PointId, or CellId, are one.
std::vector<GivenSingularity> SingularitiesOf(const GuideDataSet& dataset)
{
  vtkPointData* const arrays = dataset.Data->GetPointData();
  vtkDataArray* const atPoints = arrays->GetArray(NamesOfIds[0]);
  vtkDataArray* const ids = atPoints ? atPoints : arrays->GetArray(NamesOfIds[1]);
  const bool haveIds = ids && ids->GetNumberOfTuples() >= dataset.Data->GetNumberOfPoints();
  std::vector<GivenSingularity> given;
  std::map<double, std::size_t> numbers; // of the ids, in these
  for (vtkIdType point = 0; point < dataset.Data->GetNumberOfPoints(); ++point)
  {
    const double id = haveIds ? ids->GetComponent(point, 0) : static_cast<double>(point);
    const auto [number, isNew] = numbers.emplace(id, given.size());
    if (isNew)
    {
      given.push_back({ point, 0, Vector3::Zero() });
    }
    GivenSingularity& singularity = given[number->second];
    singularity.Sum += PositionOf(dataset, point);
    ++singularity.NumberOfPoints;
  }
  return given;
}

/// Null: 1 / N each.
vtkDataArray* IndicesOf(const GuideDataSet& dataset, const std::string& chosen)
{
  const std::string name = chosen.empty() ? NameOfIndices : chosen;
  vtkDataArray* const array = dataset.Data->GetPointData()->GetArray(name.c_str());
  if (!array && dataset.Data->GetPointData()->HasArray(name.c_str()))
  {
    throw InvalidInput("array '" + name + "' of the points of " + dataset.Name +
      " holds text, and an index is a number; choose another array as Singularity Index Array");
  }
  if (!array && !chosen.empty())
  {
    throw InvalidInput("array '" + name + "', chosen as Singularity Index Array, is not among the point arrays of " +
      dataset.Name + "; choose one of those, or none for an index of 1 / N each");
  }
  if (array && array->GetNumberOfComponents() != 1)
  {
    throw InvalidInput("array '" + name + "' of the points of " + dataset.Name + " has " +
      std::to_string(array->GetNumberOfComponents()) +
      " components, and an index is one number; choose another array as Singularity Index Array");
  }
  if (array && array->GetNumberOfTuples() < dataset.Data->GetNumberOfPoints())
  {
    throw InvalidInput("array '" + name + "' of the points of " + dataset.Name + " has " +
      std::to_string(array->GetNumberOfTuples()) + " tuples for " + std::to_string(dataset.Data->GetNumberOfPoints()) +
      " points; have its source write one for each");
  }
  return array;
}

/// The corner inside of the nearest face that is nearest.
int VertexAt(const NearestPlaces& nearest, const Vector3& position, double limit, const std::string& name)
{
  const TriangleMesh& mesh = nearest.Surface.Mesh;
  const NearestPlace place = nearest(position);
  if (place.Face < 0 || place.Distance > limit)
  {
    throw InvalidInput(
      name + " is farther from the surface than " + ShortText(limit) + "; move it nearer, or raise Maximum Distance");
  }
  int vertex = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const int corner = mesh.FaceCorners()(place.Face, k);
    const double distance = (mesh.Position(corner) - place.Position).squaredNorm();
    if (!mesh.IsBoundaryVertex(corner) && distance < least)
    {
      vertex = corner;
      least = distance;
    }
  }
  if (vertex < 0)
  {
    throw InvalidInput(name +
      " is nearest to a triangle without a point inside the surface; move it away from the boundary, or leave it out: "
      "the boundary takes what the others leave");
  }
  return vertex;
}

}

std::vector<PrescribedSingularity> BringToSurface(
  const Singularities& singularities, int N, const NearestPlaces& surface)
{
  const std::vector<GuideDataSet> datasets =
    DataSetsOf(singularities.Data, { "input Singularities", "points to Singularities" });
  std::vector<PrescribedSingularity> prescribed;
  if (datasets.empty())
  {
    return prescribed;
  }
  const double limit = singularities.MaximumDistance * surface.Sizes.Diagonal();
  for (const GuideDataSet& dataset : datasets)
  {
    vtkDataArray* const indices = IndicesOf(dataset, singularities.IndexArray);
    for (const auto& [point, numberOfPoints, sum] : SingularitiesOf(dataset))
    {
      const std::string name = "point " + std::to_string(point) + " of " + dataset.Name;
      const int times = indices ? TimesOfIndex(indices->GetComponent(point, 0), N, name) : 1;
      if (times != 0)
      {
        prescribed.push_back({ VertexAt(surface, sum / numberOfPoints, limit, name), times });
      }
    }
  }
  return prescribed;
}

}

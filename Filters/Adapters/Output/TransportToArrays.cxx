#include "Adapters/Output/TransportToArrays.h"

#include "Adapters/Output/ContoursToPolyData.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Geodesics/VertexInFront.h"
#include "Support/Errors.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>
#include <limits>
#include <utility>

namespace dmg
{

using namespace ArrayNames;

void RemoveTransportArrays(vtkDataSet* surface)
{
  for (const char* const name :
    { TransportedVectors, GeodesicDistance, GeodesicAngle, ArrayNames::LogarithmicMap, TextureCoordinates })
  {
    surface->GetCellData()->RemoveArray(name);
    surface->GetPointData()->RemoveArray(name);
  }
  for (const char* const name : { MapPoint, PointsWithoutSource, PointsWithoutMap })
  {
    surface->GetFieldData()->RemoveArray(name);
  }
}

void TransportSurface::SetSurface(const std::shared_ptr<const PreparedDataSet>& surface,
  const TransportOptions& options, const ExecutionContext& context)
{
  if (this->Prepared != surface)
  {
    this->Forget();
    this->Prepared = surface;
  }
  if (!this->Transport || this->Options.TimeStep != options.TimeStep)
  {
    this->Forget();
    this->Transport.emplace(this->Prepared->Geometry, options, context);
    this->Options = options;
  }
}

void TransportSurface::Forget()
{
  this->OfFormer = this->Counts();
  this->Transport.reset();
}

ParallelTransport::StageCounts TransportSurface::Counts() const
{
  ParallelTransport::StageCounts counts = this->OfFormer;
  if (this->Transport)
  {
    counts.Setups += this->Transport->Counts().Setups;
    counts.Solves += this->Transport->Counts().Solves;
  }
  return counts;
}

namespace
{

/// The first of several.
int NearestVertex(const TriangleMesh& mesh, const Vector3& place)
{
  if (!place.allFinite())
  {
    throw InvalidInput("Point is not finite; give three numbers");
  }
  int nearest = 0;
  (mesh.VertexPositions().rowwise() - place.transpose()).rowwise().stableNorm().minCoeff(&nearest);
  return nearest;
}

}

PlacedDirection TransportSurface::Place(const std::optional<Vector3>& place, const Vector3& direction) const
{
  const double length = direction.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length))
  {
    throw InvalidInput("Direction is zero or not finite; give a vector along the surface");
  }
  constexpr double SmallestTangentialPart = 1e-6;
  const TriangleMesh& mesh = this->Prepared->Geometry.Mesh;
  const int vertex = place ? NearestVertex(mesh, *place) : VertexInFront(mesh);
  PlacedDirection placed{ vertex, mesh.VertexPositions().row(vertex), direction, true };
  const TangentFrames& frames = this->Prepared->Geometry.Vertices;
  if (std::abs(frames.ToComplex(placed.Vertex, direction)) <= SmallestTangentialPart * length)
  {
    placed.Direction = length * frames.X.row(placed.Vertex).transpose();
    placed.IsGiven = false;
  }
  return placed;
}

namespace
{

void AddNumber(const char* name, int number, vtkDataSet* output)
{
  output->GetFieldData()->AddArray(NewValue<vtkDoubleArray>(name, static_cast<double>(number)));
}

}

std::vector<std::string> TransportSurface::AddVectors(
  const Constraints& sources, const SurfaceView& view, const ExecutionContext& context)
{
  const FramedMesh& on = this->Prepared->Geometry;
  CheckSizes(sources, view.Relation().Names());
  const TransportedField field = this->Transport->Carry(sources, context);
  view.OfCells(context).AddVectors(TransportedVectors, on.Faces, field.OnFaces);
  view.OfPoints(context).AddVectors(TransportedVectors, on.Vertices, field.AtVertices);
  view.Output()->GetPointData()->SetActiveVectors(TransportedVectors);
  AddNumber(PointsWithoutSource, field.WithoutSource, view.Output());
  return field.Warnings;
}

namespace
{

/// Distances that are not known become negative ones.
Vector<double> KnownDistances(const Vector<double>& distances)
{
  return distances.array().isNaN().select(-1.0, distances);
}

/// Makes \p output the lines of \p number distances, evenly spaced up to the largest one.
void MakeCircles(const TriangleMesh& mesh, const Vector<double>& distances, int number, const SidesOfSurface& sides,
  vtkPolyData* output, const ExecutionContext& context)
{
  std::vector<double> values;
  for (int k = 0; k < number; ++k)
  {
    values.push_back((k + 0.5) * distances.maxCoeff() / number);
  }
  const ContourLines lines = FindContourLines(mesh, mesh.VertexPositions(), distances, values, sides, context);
  ContoursToPolyData(lines, GeodesicDistance, values, output);
}

}

void TransportSurface::AddMap(const PlacedDirection& from, double textureSize, int numberOfCircles,
  const SurfaceView& view, vtkPolyData* circles, const ExecutionContext& context)
{
  vtkDataSet* const output = view.Output();
  const FramedMesh& on = this->Prepared->Geometry;
  const dmg::LogarithmicMap map =
    this->Transport->Map(from.Vertex, on.Vertices.ToComplex(from.Vertex, from.Direction), context);
  const ArraysOfPoints arrays = view.OfPoints(context, std::numeric_limits<double>::quiet_NaN());
  const auto* const coordinates = reinterpret_cast<const double*>(map.Coordinates.data());
  const double size = textureSize > 0.0 ? textureSize : 2.0 * KnownDistances(map.Distances).maxCoeff();
  const Vector<double> inTexture =
    0.5 + Eigen::Map<const Vector<double>>(coordinates, 2 * map.Coordinates.size()).array() / size;
  const Vector<double> degrees = map.Angles * (180.0 / Pi);
  arrays.Add(GeodesicDistance, 1, map.Distances.data());
  arrays.Add(GeodesicAngle, 1, degrees.data());
  arrays.Add(ArrayNames::LogarithmicMap, 2, coordinates);
  arrays.Add(TextureCoordinates, 2, inTexture.data());
  for (const char* const name : { GeodesicDistance, GeodesicAngle, ArrayNames::LogarithmicMap, TextureCoordinates })
  {
    AllowNaN(output->GetPointData()->GetArray(name)); // where no path leads
  }
  output->GetPointData()->SetActiveScalars(GeodesicDistance);
  output->GetPointData()->SetActiveTCoords(TextureCoordinates);
  AddNumber(MapPoint, view.Relation().PointOf(from.Vertex), output);
  AddNumber(PointsWithoutMap, map.Unreached, output);
  AddPositiveSide(this->Transport->Sides(), output->GetFieldData());
  MakeCircles(on.Mesh, KnownDistances(map.Distances), numberOfCircles, this->Transport->Sides(), circles, context);
  view.LinesBack(circles);
}

}

#include "Adapters/Output/TransportToArrays.h"

#include "Adapters/Output/ContoursToPolyData.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/PolyDataBuilder.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <limits>
#include <vector>

namespace dmg
{

using namespace ArrayNames;

void WriteTransported(const TransportedField& field, const SurfaceView& view, const ExecutionContext& context)
{
  const FramedMesh& on = view.Surface().Geometry;
  view.OfCells(context).AddVectors(TransportedVectors, on.Faces, field.OnFaces);
  view.OfPoints(context).AddVectors(TransportedVectors, on.Vertices, field.AtVertices);
  view.Output()->GetPointData()->SetActiveVectors(TransportedVectors);
  AddNumber(view.Output()->GetFieldData(), PointsWithoutSource, field.WithoutSource);
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

void WriteMap(const dmg::LogarithmicMap& map, int vertex, const SidesOfSurface& sides, double textureSize,
  int numberOfCircles, const SurfaceView& view, vtkPolyData* circles, const ExecutionContext& context)
{
  vtkDataSet* const output = view.Output();
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
  output->GetPointData()->AddArray(AsTextureCoordinates(output->GetPointData()->GetArray(TextureCoordinates)));
  for (const char* const name : { GeodesicDistance, GeodesicAngle, ArrayNames::LogarithmicMap, TextureCoordinates })
  {
    AllowNaN(output->GetPointData()->GetArray(name)); // where no path leads
  }
  output->GetPointData()->SetActiveScalars(GeodesicDistance);
  output->GetPointData()->SetActiveTCoords(TextureCoordinates);
  AddNumber(output->GetFieldData(), MapPoint, view.Relation().PointOf(vertex));
  AddNumber(output->GetFieldData(), PointsWithoutMap, map.Unreached);
  MakeCircles(view.Mesh(), KnownDistances(map.Distances), numberOfCircles, sides, circles, context);
  view.LinesBack(circles);
}

}

#include "Adapters/Output/DrawingToPolyData.h"

#include "Adapters/Surface/PolyDataBuilder.h"
#include "Directions/ShapeOfSingularity.h"
#include "Drawing/ThinWalls.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGlyph3D.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

Vector3 CentreOf(const TriangleMesh& mesh, int face)
{
  const auto corner = [&](int k) { return mesh.Position(mesh.FaceCorners()(face, k)); };
  return (corner(0) + corner(1) + corner(2)) / 3.0;
}

/// \param normals of the points before they are lifted.
std::vector<Vector3> NormalsOfInk(const FramedMesh& surface, const std::vector<Vector3>& positions,
  std::vector<Vector3> normals, const ExecutionContext& context)
{
  HalveNormalsAtThinWalls(surface, positions, normals, context);
  return normals;
}

/// Positions along normals, and back where the lift is negative.
std::vector<Vector3> Lifted(std::vector<Vector3> positions, const std::vector<Vector3>& normals, double lift)
{
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    positions[i] += lift * normals[i];
  }
  return positions;
}

}

void LinesToPolyData(const LinesOnSurface& lines, const std::vector<ArrowHead>& heads, const FramedMesh& surface,
  double lift, vtkPolyData* output, const ExecutionContext& context)
{
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Lines);
  std::vector<Vector3> positions, normals;
  std::vector<double> magnitudes(lines.Magnitudes);
  const auto addPoint = [&](const Vector3& position, int face)
  {
    normals.push_back(surface.Faces.Normal(face));
    positions.push_back(position);
    return drawing.AddPoint(position + lift * normals.back());
  };
  for (std::size_t i = 0; i < lines.Positions.size(); ++i)
  {
    addPoint(lines.Positions[i], lines.Faces[i]);
  }
  std::vector<int> lineOf; // of each cell
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    drawing.AddLine(lines.Offsets[line], lines.Offsets[line + 1], lines.IsClosed[line]);
    lineOf.push_back(line);
  }
  // A head is a line from one end of its base over the tip to the other: in VTK 9.1, vtkCellDataToPointData writes beyond
  // its memory where a vtkPolyData has lines and polygons.
  for (const ArrowHead& head : heads)
  {
    const int face = lines.Faces[head.Point];
    const vtkIdType base = addPoint(head.Corners[1], face);
    const vtkIdType tip = addPoint(head.Corners[0], face);
    drawing.AddCell({ base, tip, addPoint(head.Corners[2], face) });
    magnitudes.insert(magnitudes.end(), 3, lines.Magnitudes[head.Point]);
    lineOf.push_back(head.Line);
  }
  drawing.Finish(output);

  std::vector<double> lengths;
  std::vector<int> families;
  for (const int line : lineOf)
  {
    lengths.push_back(lines.Lengths[line]);
    families.push_back(lines.Families[line]);
  }
  AddToCells<vtkDoubleArray>(output, "Length", lengths);
  AddToCells<vtkIntArray>(output, "Branch", families);
  AddToCells<vtkIntArray>(output, "Seed", lineOf);
  AddToPoints<vtkDoubleArray>(output, "Magnitude", magnitudes);
  SetNormals(output, NormalsOfInk(surface, positions, std::move(normals), context));
}

void GlyphsToPolyData(const GlyphsOnSurface& glyphs, int families, bool areStrokes, const FramedMesh& surface,
  double lift, vtkPolyData* output, const ExecutionContext& context)
{
  PolyDataBuilder drawing(areStrokes ? PolyDataBuilder::Cells::Lines : PolyDataBuilder::Cells::Polygons);
  for (const Vector3& position : glyphs.Positions)
  {
    drawing.AddPoint(position);
  }
  for (int cell = 0; cell < glyphs.NumberOfCells(); ++cell)
  {
    drawing.AddCell(
      { glyphs.Corners.begin() + glyphs.Offsets[cell], glyphs.Corners.begin() + glyphs.Offsets[cell + 1] });
  }
  drawing.Finish(output);
  std::vector<int> branches(glyphs.Directions);
  for (int& branch : branches)
  {
    branch %= families;
  }
  AddToCells<vtkIntArray>(output, "Branch", branches);
  AddToCells<vtkIntArray>(output, "Direction", glyphs.Directions);
  AddToCells<vtkIntArray>(output, "Glyph", glyphs.Glyphs);
  AddToCells<vtkDoubleArray>(output, "Magnitude", glyphs.Magnitudes);
  const std::vector<Vector3> onSurface = Lifted(glyphs.Positions, glyphs.Normals, -lift);
  SetNormals(output, NormalsOfInk(surface, onSurface, glyphs.Normals, context));
}

namespace
{

/// The angle of spirals, and the axes of singularities, each an array with zeros where there are fewer.
void AddShapes(const std::vector<ShapeOfSingularity>& shapes, vtkPolyData* output)
{
  std::size_t most = 0;
  std::vector<double> angles;
  std::vector<int> numbers;
  for (const ShapeOfSingularity& shape : shapes)
  {
    most = std::max(most, shape.Axes.size());
    numbers.push_back(static_cast<int>(shape.Axes.size()));
    angles.push_back(std::isnan(shape.SpiralAngle) ? 0.0 : 180.0 / Pi * shape.SpiralAngle);
  }
  AddToPoints<vtkIntArray>(output, "NumberOfAxes", numbers);
  for (std::size_t k = 0; k < most; ++k)
  {
    std::vector<double> axes;
    for (const ShapeOfSingularity& shape : shapes)
    {
      const Vector3 axis = k < shape.Axes.size() ? shape.Axes[k] : Vector3(Vector3::Zero());
      axes.insert(axes.end(), axis.data(), axis.data() + 3);
    }
    output->GetPointData()->AddArray(NewArray<vtkDoubleArray>("Axis" + std::to_string(k), 3, axes));
  }
  AddToPoints<vtkDoubleArray>(output, "SpiralAngle", angles);
}

}

void SingularitiesToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output)
{
  const SurfaceRelation& relation = given.View.Relation();
  const TriangleMesh& mesh = given.View.Mesh();
  const bool areOnFaces = given.IsAtPoints;
  std::vector<std::pair<vtkIdType, int>> singular;
  double sum = 0.0;
  for (int element = 0; element < topology.Indices.size(); ++element)
  {
    sum += topology.Indices[element];
    if (topology.Indices[element] != 0.0)
    {
      singular.emplace_back(areOnFaces ? relation.CellOf(element) : relation.PointOf(element), element);
    }
  }
  std::sort(singular.begin(), singular.end());
  for (const BoundaryIndex& loop : topology.Loops)
  {
    sum += loop.Index;
  }

  PolyDataBuilder drawing(PolyDataBuilder::Cells::Vertices);
  std::vector<double> indices;
  std::vector<vtkIdType> ids;
  std::vector<ShapeOfSingularity> shapes;
  const Vector<Complex> first = given.Field.First();
  for (const auto& [id, element] : singular)
  {
    shapes.push_back(ShapeAt(
      given.View.Surface().Geometry, first, given.Field.N(), { element, areOnFaces, topology.Indices[element] }));
    drawing.AddCell({ drawing.AddPoint(areOnFaces ? CentreOf(mesh, element) : mesh.Position(element)) });
    indices.push_back(topology.Indices[element]);
    ids.push_back(id);
  }
  drawing.Finish(output);
  output->GetPointData()->SetScalars(NewArray<vtkDoubleArray>("Index", 1, indices));
  AddToPoints<vtkIntArray>(output, "NumberOfDirections", std::vector<int>(ids.size(), given.Field.N()));
  AddToPoints<vtkIdTypeArray>(output, areOnFaces ? "CellId" : "PointId", ids);
  AddShapes(shapes, output);
  AddHidden(output->GetFieldData(), NewValue<vtkDoubleArray>("SumOfIndices", sum));
  AddHidden(output->GetFieldData(), NewValue<vtkIntArray>("EulerCharacteristic", mesh.EulerCharacteristic()));
}

namespace
{

/// Red where Index is positive, else green; no active scalars, for which ParaView would add a scalar bar.
void ColourBySign(vtkPointData* spheres)
{
  constexpr std::array<unsigned char, 3> Red{ 212, 38, 43 }, Green{ 31, 135, 77 };
  vtkDataArray* const indices = spheres->GetArray("Index");
  std::vector<unsigned char> colours;
  for (vtkIdType point = 0; point < indices->GetNumberOfTuples(); ++point)
  {
    const auto& colour = indices->GetComponent(point, 0) < 0.0 ? Green : Red;
    colours.insert(colours.end(), colour.begin(), colour.end());
  }
  spheres->AddArray(NewArray<vtkUnsignedCharArray>("SignColor", 3, colours));
  spheres->SetActiveScalars("");
}

}

void SpheresToPolyData(vtkPolyData* singularities, double radius, vtkPolyData* output)
{
  if (singularities->GetNumberOfPoints() == 0)
  {
    return;
  }
  constexpr double MostTriangles = 4e6;
  const double perSphere = MostTriangles / static_cast<double>(singularities->GetNumberOfPoints());
  const int resolution = std::clamp(static_cast<int>(std::sqrt(0.5 * perSphere)), 4, 24);
  vtkNew<vtkSphereSource> sphere; // of 2 * resolution * (resolution - 2) triangles
  sphere->SetRadius(radius);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION); // floats end at 3e38, coordinates at 1e40
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  vtkNew<vtkGlyph3D> glyphs;
  vtkNew<vtkPolyData> copy; // the pipeline writes into the data what was asked for
  copy->ShallowCopy(singularities);
  for (int i = copy->GetPointData()->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (copy->GetPointData()->GetArray(i)->GetNumberOfComponents() > 1) // axes, which spheres as guides would offer
    {
      copy->GetPointData()->RemoveArray(i);
    }
  }
  glyphs->SetInputData(copy);
  glyphs->SetSourceConnection(sphere->GetOutputPort());
  glyphs->ScalingOff();
  glyphs->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  glyphs->Update();
  output->ShallowCopy(glyphs->GetOutput());
  ColourBySign(output->GetPointData());
  output->GetFieldData()->Initialize();
}

namespace
{

/// Lines that share their ends, with the numbers of a field's rotation across them.
class DrawnCuts
{
public:
  explicit DrawnCuts(vtkPolyData* output)
    : Output(output)
  {
  }

  /// The point of an element; \p position where it is a new one.
  vtkIdType PointOf(int element, const Vector3& position)
  {
    const auto [found, isNew] = this->Points.emplace(element, this->Drawing.NumberOfPoints());
    return isNew ? this->Drawing.AddPoint(position) : found->second;
  }
  vtkIdType AddPoint(const Vector3& position) { return this->Drawing.AddPoint(position); }

  void AddLine(const std::vector<vtkIdType>& points, int jump, double rotation)
  {
    this->Drawing.AddCell(points);
    this->Jumps.push_back(jump);
    this->Rotations.push_back(rotation);
  }

  void Finish() const
  {
    this->Drawing.Finish(this->Output);
    AddToCells<vtkIntArray>(this->Output, "Jump", this->Jumps);
    AddToCells<vtkDoubleArray>(this->Output, "Rotation", this->Rotations);
  }

private:
  vtkPolyData* const Output;
  PolyDataBuilder Drawing{ PolyDataBuilder::Cells::Lines };
  std::map<int, vtkIdType> Points;
  std::vector<int> Jumps;
  std::vector<double> Rotations;
};

/// Cuts of a field at points, between the vertices of edges: from the right of the first of them to its left, so that this
/// vertex lies on the left of the line.
void CutsBetweenVertices(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output)
{
  const TriangleMesh& mesh = given.View.Mesh();
  DrawnCuts cuts(output);
  const auto centreOf = [&](int face) { return cuts.PointOf(face, CentreOf(mesh, face)); };
  for (std::size_t i = 0; i < topology.Cuts.size(); ++i)
  {
    const int h = mesh.HalfedgeOf(topology.Cuts[i]);
    std::vector<vtkIdType> line;
    if (mesh.Twin(h) >= 0)
    {
      line.push_back(centreOf(TriangleMesh::FaceOf(mesh.Twin(h))));
    }
    line.push_back(cuts.AddPoint(0.5 * (mesh.Position(mesh.Tail(h)) + mesh.Position(mesh.Head(h)))));
    line.push_back(centreOf(TriangleMesh::FaceOf(h)));
    cuts.AddLine(line, topology.Jumps[i], topology.Rotation[topology.Cuts[i]]);
  }
  cuts.Finish();
}

}

void CutsToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output)
{
  if (given.IsAtPoints)
  {
    CutsBetweenVertices(given, topology, output);
    return;
  }
  const SurfaceRelation& relation = given.View.Relation();
  const TriangleMesh& mesh = given.View.Mesh();
  const int N = given.Field.N();
  struct Cut
  {
    int From, To; // the vertices, as the line runs: from its smaller to its larger point
    int Jump;
    double Rotation;
    int Edge;
  };
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < topology.Cuts.size(); ++i)
  {
    const int edge = topology.Cuts[i];
    const int h = mesh.HalfedgeOf(edge);
    const int tail = mesh.Tail(h);
    const int head = mesh.Head(h);
    const bool isAlong = relation.PointOf(tail) < relation.PointOf(head);
    cuts.push_back({ isAlong ? tail : head, isAlong ? head : tail, isAlong ? topology.Jumps[i] : N - topology.Jumps[i],
      (isAlong ? 1.0 : -1.0) * topology.Rotation[edge], edge });
  }
  std::sort(cuts.begin(), cuts.end(),
    [&relation](const Cut& a, const Cut& b)
    {
      const auto ends = [&relation](const Cut& cut) {
        return std::array{ relation.PointOf(cut.From), relation.PointOf(cut.To), cut.From, cut.To };
      };
      return ends(a) < ends(b);
    });
  DrawnCuts drawn(output);
  for (const Cut& cut : cuts)
  {
    const vtkIdType from = drawn.PointOf(cut.From, mesh.Position(cut.From));
    drawn.AddLine({ from, drawn.PointOf(cut.To, mesh.Position(cut.To)) }, cut.Jump, cut.Rotation);
  }
  drawn.Finish();
}

void BoundaryLoopsToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output)
{
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Lines);
  std::vector<double> indices;
  for (const BoundaryIndex& loop : topology.Loops)
  {
    const vtkIdType first = drawing.NumberOfPoints();
    for (const int vertex : loop.Vertices)
    {
      drawing.AddPoint(given.View.Mesh().Position(vertex));
    }
    drawing.AddLine(first, drawing.NumberOfPoints(), true);
    indices.push_back(loop.Index);
  }
  drawing.Finish(output);
  output->GetCellData()->SetScalars(NewArray<vtkDoubleArray>("Index", 1, indices));
}

}

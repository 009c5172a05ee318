#include "Adapters/Output/DrawingToPolyData.h"

#include "Adapters/Surface/ElementArrays.h"
#include "Drawing/ThinWalls.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGlyph3D.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// An array of values, one after the other.
template <class Array, class Value>
vtkSmartPointer<Array> NewArray(const char* name, int components, const Value* values, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::copy_n(values, components * tuples, array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkDoubleArray> NewVectors(const char* name, const std::vector<Vector3>& vectors)
{
  return NewArray<vtkDoubleArray>(
    name, 3, vectors.empty() ? nullptr : vectors.front().data(), static_cast<vtkIdType>(vectors.size()));
}

Vector3 CentreOf(const TriangleMesh& mesh, int face)
{
  const auto corner = [&](int k) { return mesh.Position(mesh.FaceCorners()(face, k)); };
  return (corner(0) + corner(1) + corner(2)) / 3.0;
}

vtkSmartPointer<vtkPoints> NewPoints(const std::vector<Vector3>& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(NewVectors("Points", positions));
  return points;
}

/// \param normals of the points before they are lifted.
vtkSmartPointer<vtkDoubleArray> NormalsOfInk(const FramedMesh& surface, const std::vector<Vector3>& positions,
  std::vector<Vector3> normals, const ExecutionContext& context)
{
  HalveNormalsAtThinWalls(surface, positions, normals, context);
  return NewVectors("Normals", normals);
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
  std::vector<Vector3> positions;
  std::vector<Vector3> normals;
  std::vector<double> magnitudes(lines.Magnitudes);
  const auto addPoint = [&](const Vector3& position, int face)
  {
    normals.push_back(surface.Faces.Normal(face));
    positions.push_back(position);
    return static_cast<vtkIdType>(positions.size() - 1);
  };
  for (std::size_t i = 0; i < lines.Positions.size(); ++i)
  {
    addPoint(lines.Positions[i], lines.Faces[i]);
  }
  vtkNew<vtkCellArray> polylines;
  std::vector<vtkIdType> ids;
  std::vector<int> lineOf; // of each cell
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    ids.resize(lines.Offsets[line + 1] - lines.Offsets[line]);
    std::iota(ids.begin(), ids.end(), lines.Offsets[line]);
    if (lines.IsClosed[line])
    {
      ids.push_back(ids.front());
    }
    polylines->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    lineOf.push_back(line);
  }
  // A head is a line from one end of its base over the tip to the other: in VTK 9.1, vtkCellDataToPointData writes beyond
  // its memory where a vtkPolyData has lines and polygons.
  for (const ArrowHead& head : heads)
  {
    const int face = lines.Faces[head.Point];
    const vtkIdType corners[] = { addPoint(head.Corners[1], face), addPoint(head.Corners[0], face),
      addPoint(head.Corners[2], face) };
    magnitudes.insert(magnitudes.end(), 3, lines.Magnitudes[head.Point]);
    polylines->InsertNextCell(3, corners);
    lineOf.push_back(head.Line);
  }
  output->SetPoints(NewPoints(Lifted(positions, normals, lift)));
  output->SetLines(polylines);

  std::vector<double> lengths;
  std::vector<int> families;
  for (const int line : lineOf)
  {
    lengths.push_back(lines.Lengths[line]);
    families.push_back(lines.Families[line]);
  }
  const vtkIdType numberOfCells = static_cast<vtkIdType>(lineOf.size());
  vtkCellData* const ofCells = output->GetCellData();
  ofCells->AddArray(NewArray<vtkDoubleArray>("Length", 1, lengths.data(), numberOfCells));
  ofCells->AddArray(NewArray<vtkIntArray>("Branch", 1, families.data(), numberOfCells));
  ofCells->AddArray(NewArray<vtkIntArray>("Seed", 1, lineOf.data(), numberOfCells));
  vtkPointData* const ofPoints = output->GetPointData();
  ofPoints->AddArray(
    NewArray<vtkDoubleArray>("Magnitude", 1, magnitudes.data(), static_cast<vtkIdType>(magnitudes.size())));
  ofPoints->SetNormals(NormalsOfInk(surface, positions, normals, context));
}

void GlyphsToPolyData(const GlyphsOnSurface& glyphs, int families, bool areStrokes, const FramedMesh& surface,
  double lift, vtkPolyData* output, const ExecutionContext& context)
{
  const int numberOfCells = glyphs.NumberOfCells();
  vtkNew<vtkCellArray> cells;
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    const std::vector<vtkIdType> ids(
      glyphs.Corners.begin() + glyphs.Offsets[cell], glyphs.Corners.begin() + glyphs.Offsets[cell + 1]);
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  output->SetPoints(NewPoints(glyphs.Positions));
  areStrokes ? output->SetLines(cells) : output->SetPolys(cells);
  std::vector<int> branches(glyphs.Directions);
  for (int& branch : branches)
  {
    branch %= families;
  }
  vtkCellData* const ofCells = output->GetCellData();
  ofCells->AddArray(NewArray<vtkIntArray>("Branch", 1, branches.data(), numberOfCells));
  ofCells->AddArray(NewArray<vtkIntArray>("Direction", 1, glyphs.Directions.data(), numberOfCells));
  ofCells->AddArray(NewArray<vtkIntArray>("Glyph", 1, glyphs.Glyphs.data(), numberOfCells));
  ofCells->AddArray(NewArray<vtkDoubleArray>("Magnitude", 1, glyphs.Magnitudes.data(), numberOfCells));
  output->GetPointData()->SetNormals(
    NormalsOfInk(surface, Lifted(glyphs.Positions, glyphs.Normals, -lift), glyphs.Normals, context));
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

  std::vector<Vector3> positions;
  std::vector<double> indices;
  std::vector<vtkIdType> ids;
  vtkNew<vtkCellArray> cells;
  for (const auto& [id, element] : singular)
  {
    cells->InsertNextCell({ static_cast<vtkIdType>(positions.size()) });
    positions.push_back(areOnFaces ? CentreOf(mesh, element) : mesh.Position(element));
    indices.push_back(topology.Indices[element]);
    ids.push_back(id);
  }
  const vtkIdType size = static_cast<vtkIdType>(positions.size());
  const std::vector<int> N(positions.size(), given.Field.N());
  output->SetPoints(NewPoints(positions));
  output->SetVerts(cells);
  vtkPointData* const ofPoints = output->GetPointData();
  ofPoints->SetScalars(NewArray<vtkDoubleArray>("Index", 1, indices.data(), size));
  ofPoints->AddArray(NewArray<vtkIntArray>("NumberOfDirections", 1, N.data(), size));
  ofPoints->AddArray(NewArray<vtkIdTypeArray>(areOnFaces ? "CellId" : "PointId", 1, ids.data(), size));
  const int euler = mesh.EulerCharacteristic();
  AddHidden(output->GetFieldData(), NewArray<vtkDoubleArray>("SumOfIndices", 1, &sum, 1));
  AddHidden(output->GetFieldData(), NewArray<vtkIntArray>("EulerCharacteristic", 1, &euler, 1));
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
  spheres->AddArray(NewArray<vtkUnsignedCharArray>("SignColor", 3, colours.data(), indices->GetNumberOfTuples()));
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

/// Cuts of a field at points, between the vertices of edges: from the right of the first of them to its left, so that this
/// vertex lies on the left of the line.
void CutsBetweenVertices(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output)
{
  const TriangleMesh& mesh = given.View.Mesh();
  std::vector<Vector3> positions;
  std::map<int, vtkIdType> centres; // of faces, in the output
  const auto centreOf = [&](int face)
  {
    const auto [found, isNew] = centres.emplace(face, positions.size());
    if (isNew)
    {
      positions.push_back(CentreOf(mesh, face));
    }
    return found->second;
  };
  std::vector<double> rotations;
  vtkNew<vtkCellArray> cells;
  for (const int edge : topology.Cuts)
  {
    const int h = mesh.HalfedgeOf(edge);
    std::vector<vtkIdType> line;
    if (mesh.Twin(h) >= 0)
    {
      line.push_back(centreOf(TriangleMesh::FaceOf(mesh.Twin(h))));
    }
    line.push_back(static_cast<vtkIdType>(positions.size()));
    positions.push_back(0.5 * (mesh.Position(mesh.Tail(h)) + mesh.Position(mesh.Head(h))));
    line.push_back(centreOf(TriangleMesh::FaceOf(h)));
    cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
    rotations.push_back(topology.Rotation[edge]);
  }
  const vtkIdType size = static_cast<vtkIdType>(topology.Cuts.size());
  output->SetPoints(NewPoints(positions));
  output->SetLines(cells);
  vtkCellData* const ofCells = output->GetCellData();
  ofCells->AddArray(NewArray<vtkIntArray>("Jump", 1, topology.Jumps.data(), size));
  ofCells->AddArray(NewArray<vtkDoubleArray>("Rotation", 1, rotations.data(), size));
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
  std::map<int, vtkIdType> numbers; // of the ends, in the output
  std::vector<Vector3> positions;
  std::vector<int> jumps;
  std::vector<double> rotations;
  vtkNew<vtkCellArray> cells;
  for (const Cut& cut : cuts)
  {
    vtkIdType ends[2];
    int at = 0;
    for (const int vertex : { cut.From, cut.To })
    {
      const auto [found, isNew] = numbers.emplace(vertex, positions.size());
      if (isNew)
      {
        positions.push_back(mesh.Position(vertex));
      }
      ends[at++] = found->second;
    }
    cells->InsertNextCell(2, ends);
    jumps.push_back(cut.Jump);
    rotations.push_back(cut.Rotation);
  }
  const vtkIdType size = static_cast<vtkIdType>(cuts.size());
  output->SetPoints(NewPoints(positions));
  output->SetLines(cells);
  vtkCellData* const ofCells = output->GetCellData();
  ofCells->AddArray(NewArray<vtkIntArray>("Jump", 1, jumps.data(), size));
  ofCells->AddArray(NewArray<vtkDoubleArray>("Rotation", 1, rotations.data(), size));
}

void BoundaryLoopsToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output)
{
  std::vector<Vector3> positions;
  std::vector<double> indices;
  vtkNew<vtkCellArray> cells;
  for (const BoundaryIndex& loop : topology.Loops)
  {
    std::vector<vtkIdType> ids(loop.Vertices.size());
    std::iota(ids.begin(), ids.end(), static_cast<vtkIdType>(positions.size()));
    ids.push_back(ids.front());
    for (const int vertex : loop.Vertices)
    {
      positions.push_back(given.View.Mesh().Position(vertex));
    }
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    indices.push_back(loop.Index);
  }
  output->SetPoints(NewPoints(positions));
  output->SetLines(cells);
  output->GetCellData()->SetScalars(
    NewArray<vtkDoubleArray>("Index", 1, indices.data(), static_cast<vtkIdType>(indices.size())));
}

}

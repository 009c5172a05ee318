#include "vtkHodgeDecomposition.h"

#include "TestTools.h"

#include "vtkCellData.h"
#include "vtkExtractEdges.h"
#include "vtkHarmonicFieldSolver.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace dmg::test;
using dmg::Pi;
using dmg::Vector3;
using VectorAt = std::function<Vector3(const Vector3&)>;

Vector3 PointOf(vtkPolyData* surface, vtkIdType point)
{
  return Vector3(surface->GetPoint(point));
}

Vector3 CentreOf(vtkPolyData* surface, vtkIdType cell)
{
  vtkIdType size;
  const vtkIdType* corners;
  surface->GetCellPoints(cell, size, corners);
  Vector3 centre = Vector3::Zero();
  for (vtkIdType k = 0; k < size; ++k)
  {
    centre += PointOf(surface, corners[k]) / static_cast<double>(size);
  }
  return centre;
}

vtkSmartPointer<vtkPolyData> WithCellVectors(const Surface& shape, const VectorAt& field)
{
  const auto surface = PolyDataOf(shape);
  const auto vectors = Zeros("Flow", surface->GetNumberOfCells(), 3);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    vectors->SetTuple(cell, field(CentreOf(surface, cell)).data());
  }
  surface->GetCellData()->SetVectors(vectors);
  return surface;
}

vtkSmartPointer<vtkPolyData> WithPointVectors(const Surface& shape, const VectorAt& field)
{
  const auto surface = PolyDataOf(shape);
  const auto vectors = Zeros("Flow", surface->GetNumberOfPoints(), 3);
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    vectors->SetTuple(point, field(PointOf(surface, point)).data());
  }
  surface->GetPointData()->SetVectors(vectors);
  return surface;
}

Vector3 Rotation(const Vector3& p)
{
  return Vector3(-p[1], p[0], 0.0);
}

/// Between circles of radius 1 and 2: the flow of a vortex, with a source, and a lift that is not tangential.
Vector3 VortexAndSource(const Vector3& p)
{
  return Vector3((Vector3(-p[1], p[0], 0.0) + 0.5 * Vector3(p[0], p[1], 0.0)) / p.squaredNorm() + Vector3(0, 0, 3));
}

/// A spherical harmonic of degree 4, z Re (x + i y)^3, and the quarter turn of its gradient.
double Wave(const Vector3& p)
{
  return p[2] * (p[0] * p[0] * p[0] - 3.0 * p[0] * p[1] * p[1]);
}

Vector3 VelocityOfWave(const Vector3& p)
{
  return p.cross(Vector3(3.0 * p[2] * (p[0] * p[0] - p[1] * p[1]), -6.0 * p[0] * p[1] * p[2],
    p[0] * p[0] * p[0] - 3.0 * p[0] * p[1] * p[1]));
}

using Shape = std::function<vtkSmartPointer<vtkPolyData>(int)>;

/// The unit sphere in quadrilaterals, and triangles around its poles.
vtkSmartPointer<vtkPolyData> LatitudesAndLongitudes(int level)
{
  const int around = 6 << level;
  const int bands = around / 2;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int j = 1; j < bands; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const double latitude = Pi * j / bands - 0.5 * Pi;
      const double longitude = 2.0 * Pi * i / around;
      points->InsertNextPoint(
        std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    }
  }
  const vtkIdType south = points->InsertNextPoint(0.0, 0.0, -1.0);
  const vtkIdType north = points->InsertNextPoint(0.0, 0.0, 1.0);
  const auto at = [around](int i, int j) { return static_cast<vtkIdType>((j - 1) * around + i % around); };
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < around; ++i)
  {
    cells->InsertNextCell({ south, at(i + 1, 1), at(i, 1) });
    for (int j = 1; j + 1 < bands; ++j)
    {
      cells->InsertNextCell({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
    }
    cells->InsertNextCell({ at(i, bands - 1), at(i + 1, bands - 1), north });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

/// The unit sphere in hexagons and twelve pentagons: the dual of an icosphere.
vtkSmartPointer<vtkPolyData> Hexagons(int level)
{
  const dmg::TriangleMesh mesh = Icosphere(level).Mesh();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      centre += mesh.Position(mesh.FaceCorners()(face, k));
    }
    points->InsertNextPoint(centre.normalized().eval().data());
  }
  vtkNew<vtkCellArray> cells;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    std::vector<vtkIdType> corners;
    mesh.VisitFan(vertex, [&](int h) { corners.push_back(dmg::TriangleMesh::FaceOf(h)); });
    cells->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

/// The edges of a surface as lines.
/// \param isMerged with points of their own, in another order.
vtkSmartPointer<vtkPolyData> EdgesOf(vtkPolyData* surface, bool isMerged)
{
  vtkNew<vtkExtractEdges> filter;
  filter->SetInputData(surface);
  filter->SetUseAllPoints(!isMerged);
  filter->Update();
  return filter->GetOutput();
}

/// \param integral of the way from one point to another.
void AddIntegrals(
  vtkPolyData* edges, const std::string& name, const std::function<double(const Vector3&, const Vector3&)>& integral)
{
  const auto values = Zeros(name, edges->GetNumberOfCells(), 1);
  for (vtkIdType line = 0; line < edges->GetNumberOfCells(); ++line)
  {
    vtkIdType size;
    const vtkIdType* ends;
    edges->GetCellPoints(line, size, ends);
    values->SetValue(line, integral(PointOf(edges, ends[0]), PointOf(edges, ends[1])));
  }
  edges->GetCellData()->AddArray(values);
}

double LargestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    largest = std::max(largest, std::abs(a[k] - b[k]));
  }
  return largest;
}

double RelativeError(const std::vector<double>& found, const std::function<double(vtkIdType)>& expected)
{
  double error = 0.0;
  double scale = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const double value = expected(static_cast<vtkIdType>(k));
    error += (found[k] - value) * (found[k] - value);
    scale += value * value;
  }
  return std::sqrt(error / scale);
}

}

TEST(HodgeDecomposition, PartsOfCellsSumToTheTangentialFlow)
{
  vtkNew<vtkHodgeDecomposition> filter;
  const auto input = WithCellVectors(Annulus(48, 12), VortexAndSource);
  filter->SetInputData(input);
  filter->Update();
  vtkPolyData* const output = filter->GetPolyDataOutput();
  vtkCellData* const cells = output->GetCellData();
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    const Vector3 sum = Tuple(cells, "GradientPart", cell) + Tuple(cells, "RotationalPart", cell) +
      Tuple(cells, "HarmonicPart", cell) + Tuple(cells, "Residual", cell);
    Vector3 flow = Tuple(cells, "Flow", cell);
    EXPECT_NEAR(std::abs(Values(cells, "NormalComponent")[cell]), 3.0, 1e-12);
    flow[2] = 0.0;
    ASSERT_LT((sum - flow).norm(), 1e-12);
  }
  const std::vector<double> energies = Values(output->GetFieldData(), "FlowEnergies");
  ASSERT_EQ(energies.size(), 5u);
  EXPECT_NEAR(energies[1] + energies[2] + energies[3] + energies[4], energies[0], 1e-10 * energies[0]);
  // The energy of a vortex of circulation 2 pi, 2 pi log 2, and of the source, a quarter of it.
  EXPECT_NEAR(energies[2], 2.0 * Pi * std::log(2.0), 0.02 * energies[2]);
  EXPECT_NEAR(energies[1], 0.5 * Pi * std::log(2.0), 0.02 * energies[1]);
  const std::vector<double> shares = Values(output->GetFieldData(), "FlowShares");
  EXPECT_NEAR(shares[0], energies[1] / energies[0], 1e-14);
}

TEST(HodgeDecomposition, BoundariesHaveCirculationFluxAndTransport)
{
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(WithCellVectors(Annulus(96, 24), VortexAndSource));
  filter->SetLengthScale(10.0);
  filter->Update();
  vtkFieldData* const data = filter->GetOutput()->GetFieldData();
  // The outer circle is the first.
  EXPECT_NEAR(Values(data, "BoundaryLength")[0], 40.0 * Pi, 0.1);
  EXPECT_NEAR(Values(data, "BoundaryCirculation")[0], 20.0 * Pi, 0.05);
  EXPECT_NEAR(Values(data, "BoundaryCirculation")[1], -20.0 * Pi, 0.05);
  EXPECT_NEAR(Values(data, "BoundaryFlux")[0], 10.0 * Pi, 0.05);
  EXPECT_NEAR(Values(data, "BoundaryFlux")[1], -10.0 * Pi, 0.05);
  EXPECT_EQ(Values(data, "BoundaryStreamFunction")[0], 0.0);
  EXPECT_NEAR(Values(data, "BoundaryStreamFunction")[1], -10.0 * std::log(2.0), 0.01);
  for (const double point : Values(data, "BoundaryPoint"))
  {
    const double radius = PointOf(filter->GetPolyDataOutput(), static_cast<vtkIdType>(point)).norm();
    EXPECT_TRUE(std::abs(radius - 1.0) < 1e-12 || std::abs(radius - 2.0) < 1e-12);
  }
}

// The second output has a line and these numbers for each.
TEST(HodgeDecomposition, TransportsAreMeasuredAgainstAnyBoundary)
{
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(WithCellVectors(Annulus(96, 24), VortexAndSource));
  filter->Update();
  vtkPolyData* const boundaries = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(2));
  ASSERT_EQ(boundaries->GetNumberOfCells(), 2);
  vtkFieldData* const data = filter->GetOutput()->GetFieldData();
  for (const char* const name : { "BoundaryLength", "BoundaryCirculation", "BoundaryFlux", "BoundaryStreamFunction" })
  {
    EXPECT_EQ(Values(boundaries->GetCellData(), name), Values(data, name)) << name;
  }
  for (vtkIdType line = 0; line < 2; ++line)
  {
    vtkCell* const loop = boundaries->GetCell(line);
    EXPECT_EQ(loop->GetPointId(0), loop->GetPointId(loop->GetNumberOfPoints() - 1)) << "is closed";
    EXPECT_NEAR(PointOf(boundaries, loop->GetPointId(5)).norm(), line == 0 ? 2.0 : 1.0, 1e-12);
  }
  EXPECT_NEAR(Values(boundaries->GetCellData(), "BoundaryTransport")[1], -std::log(2.0), 0.001);
  filter->SetReferenceBoundary(1);
  filter->Update();
  EXPECT_NEAR(Values(boundaries->GetCellData(), "BoundaryTransport")[0], std::log(2.0), 0.001);
  EXPECT_EQ(Values(boundaries->GetCellData(), "BoundaryTransport")[1], 0.0);
  filter->SetReferenceBoundary(2);
  const Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("Reference Boundary is 2, and the surface has 2 boundaries"), std::string::npos);
}

TEST(HodgeDecomposition, OpenBoundariesLeaveTheSourceFlowToTheHarmonicPart)
{
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(WithCellVectors(Annulus(48, 12), VortexAndSource));
  filter->SetBoundary(vtkHodgeDecomposition::Open);
  filter->Update();
  const std::vector<double> shares = Values(filter->GetOutput()->GetFieldData(), "FlowShares");
  EXPECT_LT(shares[0], 1e-3);
  EXPECT_NEAR(shares[1], 0.8, 0.01);
  EXPECT_NEAR(shares[2], 0.2, 0.01);
  EXPECT_EQ(Values(filter->GetOutput()->GetFieldData(), "HarmonicCoefficients").size(), 1u);
}

TEST(HodgeDecomposition, VectorsOfPointsAndComponentsGiveTheSameFlow)
{
  const auto input = WithPointVectors(IrregularSphere(4, 3), Rotation);
  vtkNew<vtkHodgeDecomposition> ofPoints;
  ofPoints->SetInputData(input);
  ofPoints->Update();
  const std::vector<double> psi = Values(ofPoints->GetOutput()->GetPointData(), "StreamFunction");
  EXPECT_LT(RelativeError(psi, [&](vtkIdType point) { return -PointOf(input, point)[2]; }), 0.01);
  // Twice the sine of the latitude, as of all rotations.
  EXPECT_LT(RelativeError(Values(ofPoints->GetOutput()->GetPointData(), "Vorticity"),
              [&](vtkIdType point) { return 2.0 * PointOf(input, point)[2]; }),
    0.02);

  const auto components = PolyDataOf(IrregularSphere(4, 3));
  const auto eastward = Zeros("u", components->GetNumberOfPoints(), 1);
  const auto northward = Zeros("v", components->GetNumberOfPoints(), 1);
  for (vtkIdType point = 0; point < components->GetNumberOfPoints(); ++point)
  {
    const Vector3 p = PointOf(components, point);
    eastward->SetValue(point, std::hypot(p[0], p[1]));
  }
  components->GetPointData()->AddArray(eastward);
  components->GetPointData()->AddArray(northward);
  vtkNew<vtkHodgeDecomposition> ofComponents;
  ofComponents->SetInputData(components);
  ofComponents->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "u");
  ofComponents->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "v");
  ofComponents->Update();
  const std::vector<double> same = Values(ofComponents->GetOutput()->GetPointData(), "StreamFunction");
  ASSERT_EQ(same.size(), psi.size());
  for (std::size_t k = 0; k < psi.size(); ++k)
  {
    ASSERT_NEAR(same[k], psi[k], 1e-9);
  }
}

TEST(HodgeDecomposition, NorthwardIsTowardsTheAxis)
{
  const auto surface = PolyDataOf(IrregularSphere(4, 3));
  const auto zero = Zeros("u", surface->GetNumberOfCells(), 1);
  const auto northward = Zeros("v", surface->GetNumberOfCells(), 1);
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    const Vector3 p = CentreOf(surface, cell);
    northward->SetValue(cell, std::hypot(p[1], p[2]) / p.norm()); // the gradient of x
  }
  surface->GetCellData()->AddArray(zero);
  surface->GetCellData()->AddArray(northward);
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(surface);
  filter->SetAxis(7.0, 0.0, 0.0);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "u");
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "v");
  filter->Update();
  EXPECT_LT(RelativeError(Values(filter->GetOutput()->GetPointData(), "Potential"),
              [&](vtkIdType point) { return PointOf(surface, point)[0]; }),
    0.01);
}

TEST(HodgeDecomposition, AFormOnEdgesOfALinearFlowGivesTheSamePartsAsItsVectors)
{
  // A rotation and a constant, of which the form knows all.
  const auto field = [](const Vector3& p) { return Vector3(1.0 - 3.0 * p[1], 2.0 + 3.0 * p[0], 0.0); };
  const auto surface = WithCellVectors(IrregularPlane(12, 9, 5), field);
  vtkNew<vtkHodgeDecomposition> ofVectors;
  ofVectors->SetInputData(surface);
  ofVectors->Update();
  for (const bool isMerged : { false, true })
  {
    SCOPED_TRACE(isMerged);
    const double tolerance = isMerged ? 1e-4 : 1e-9; // the other points are in single precision
    const auto edges = EdgesOf(surface, isMerged);
    AddIntegrals(
      edges, "Circulation", [&](const Vector3& a, const Vector3& b) { return field(0.5 * (a + b)).dot(b - a); });
    AddIntegrals(edges, "Velocity",
      [&](const Vector3& a, const Vector3& b) { return field(0.5 * (a + b)).dot((b - a).normalized()); });
    for (const int kind : { vtkHodgeDecomposition::Integrals, vtkHodgeDecomposition::Components })
    {
      vtkNew<vtkHodgeDecomposition> ofForm;
      ofForm->SetInputData(surface);
      ofForm->SetInputData(1, edges);
      ofForm->SetEdgeValues(kind);
      ofForm->SetEdgeArray(kind == vtkHodgeDecomposition::Integrals ? "Circulation" : "Velocity");
      Messages messages(ofForm);
      ofForm->Update();
      EXPECT_TRUE(messages.Silent()) << messages.Error();
      for (const char* const name : { "GradientPart", "RotationalPart", "Residual" })
      {
        EXPECT_LT(LargestDifference(Values(ofForm->GetOutput()->GetCellData(), name),
                    Values(ofVectors->GetOutput()->GetCellData(), name)),
          tolerance)
          << name;
      }
      EXPECT_FALSE(ofForm->GetOutput()->GetCellData()->HasArray("NormalComponent"));
      for (const double vorticity : Values(ofForm->GetOutput()->GetPointData(), "Vorticity"))
      {
        EXPECT_NEAR(vorticity, 6.0, tolerance);
      }
    }
  }
}

TEST(HodgeDecomposition, DifferencesOfAFunctionOnEdgesArePureGradients)
{
  const auto function = [](const Vector3& p) { return std::sin(2.0 * p[0]) + p[1] * p[2]; };
  for (const auto& surface : { PolyDataOf(IrregularTorus(30, 16, 3)), LatitudesAndLongitudes(3), Hexagons(3) })
  {
    const auto edges = EdgesOf(surface, false);
    AddIntegrals(edges, "OneForm", [&](const Vector3& a, const Vector3& b) { return function(b) - function(a); });
    vtkNew<vtkHodgeDecomposition> filter;
    filter->SetInputData(surface);
    filter->SetInputData(1, edges);
    filter->Update();
    const std::vector<double> energies = Values(filter->GetOutput()->GetFieldData(), "FlowEnergies");
    EXPECT_NEAR(energies[1], energies[0], 1e-12 * energies[0]);
    EXPECT_LT(energies[2] + energies[3] + energies[4], 1e-18 * energies[0]);
    const std::vector<double> u = Values(filter->GetOutput()->GetPointData(), "Potential");
    const std::vector<double> vorticity = Values(filter->GetOutput()->GetPointData(), "Vorticity");
    const double shift = u[0] - function(PointOf(surface, 0));
    for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
    {
      ASSERT_NEAR(u[point], function(PointOf(surface, point)) + shift, 1e-9);
      ASSERT_NEAR(vorticity[point], 0.0, 1e-10);
    }
  }
}

TEST(HodgeDecomposition, TheFormOfASolverIsAFlow)
{
  const auto surface = PolyDataOf(IrregularTorus(30, 16, 3));
  AddVectors(surface->GetCellData(), "Given", surface->GetNumberOfCells(), { { 7, Vector3(0.0, 1.0, 0.3) } });
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetDiscretisation(vtkHarmonicFieldSolver::OneForm);
  solver->SetInputData(surface);
  solver->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Given");
  solver->SetUnitLength(false);
  vtkNew<vtkHodgeDecomposition> ofForm;
  ofForm->SetInputConnection(0, solver->GetOutputPort(0));
  ofForm->SetInputConnection(1, solver->GetOutputPort(1));
  Messages messages(ofForm);
  ofForm->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  // Its vectors on cells are those of the form at the centres.
  vtkNew<vtkHodgeDecomposition> ofVectors;
  ofVectors->SetInputConnection(solver->GetOutputPort(0));
  ofVectors->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Direction0");
  ofVectors->Update();
  for (const char* const name : { "GradientPart", "RotationalPart", "HarmonicPart", "Residual" })
  {
    EXPECT_LT(LargestDifference(
                Values(ofForm->GetOutput()->GetCellData(), name), Values(ofVectors->GetOutput()->GetCellData(), name)),
      1e-9)
      << name;
  }
  EXPECT_GT(Values(ofForm->GetOutput()->GetFieldData(), "FlowShares")[2], 0.5); // around the handle
}

TEST(HodgeDecomposition, EdgesThatLackSomethingAreTold)
{
  const auto surface = PolyDataOf(Icosphere(2));
  const auto one = [](const Vector3&, const Vector3&) { return 1.0; };
  const auto errorOf = [&](vtkPolyData* edges)
  {
    vtkNew<vtkHodgeDecomposition> filter;
    filter->SetInputData(surface);
    filter->SetInputData(1, edges);
    Messages messages(filter);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    return messages.Error();
  };
  const auto edges = EdgesOf(surface, true);
  EXPECT_NE(errorOf(edges).find("OneForm"), std::string::npos); // there is no such array
  AddIntegrals(edges, "OneForm", one);
  edges->GetCellData()->GetArray("OneForm")->SetComponent(5, 0, std::nan(""));
  EXPECT_NE(errorOf(edges).find("not finite on line 5"), std::string::npos);
  vtkNew<vtkPolyData> some;
  some->SetPoints(surface->GetPoints());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  some->SetLines(lines);
  AddIntegrals(some, "OneForm", one);
  EXPECT_NE(errorOf(some).find("no line of the edges joins points"), std::string::npos);
  vtkNew<vtkPolyData> longLine;
  longLine->SetPoints(surface->GetPoints());
  vtkNew<vtkCellArray> polyline;
  polyline->InsertNextCell({ 0, 1, 2 });
  longLine->SetLines(polyline);
  longLine->GetCellData()->AddArray(Zeros("OneForm", 1, 1));
  EXPECT_NE(errorOf(longLine).find("a line of its own"), std::string::npos);
}

TEST(HodgeDecomposition, QuadsAndHexagonsConvergeAsTriangles)
{
  for (const auto& [name, shape] :
    std::vector<std::pair<std::string, Shape>>{ { "quads", LatitudesAndLongitudes }, { "hexagons", Hexagons } })
  {
    SCOPED_TRACE(name);
    std::vector<double> errors;
    for (const int level : { 2, 3, 4 })
    {
      const auto surface = shape(level);
      const auto vectors = Zeros("Flow", surface->GetNumberOfPoints(), 3);
      for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
      {
        vectors->SetTuple(point, VelocityOfWave(PointOf(surface, point)).data());
      }
      surface->GetPointData()->SetVectors(vectors);
      vtkNew<vtkHodgeDecomposition> filter;
      filter->SetInputData(surface);
      Messages messages(filter);
      filter->Update();
      EXPECT_TRUE(messages.Silent()) << messages.Error();
      ASSERT_EQ(filter->GetOutput()->GetNumberOfCells(), surface->GetNumberOfCells());
      EXPECT_EQ(filter->GetOutput()->GetCellData()->GetArray("RotationalPart")->GetNumberOfTuples(),
        surface->GetNumberOfCells());
      errors.push_back(RelativeError(Values(filter->GetOutput()->GetPointData(), "StreamFunction"),
        [&](vtkIdType point) { return Wave(PointOf(surface, point)); }));
    }
    EXPECT_GT(0.5 * std::log2(errors[0] / errors[2]), 1.8) << errors[0] << " " << errors[1] << " " << errors[2];
  }
}

TEST(HodgeDecomposition, AnyDataSetComesOutAsItWas)
{
  const auto triangles = WithPointVectors(Icosphere(3), Rotation);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(triangles->GetPoints());
  grid->SetCells(VTK_TRIANGLE, triangles->GetPolys());
  grid->GetPointData()->SetVectors(triangles->GetPointData()->GetVectors());
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(grid);
  filter->Update();
  ASSERT_TRUE(filter->GetOutput()->IsA("vtkUnstructuredGrid"));
  vtkNew<vtkHodgeDecomposition> ofTriangles;
  ofTriangles->SetInputData(triangles);
  ofTriangles->Update();
  EXPECT_EQ(Values(filter->GetOutput()->GetPointData(), "StreamFunction"),
    Values(ofTriangles->GetOutput()->GetPointData(), "StreamFunction"));
}

TEST(HodgeDecomposition, SeamsCloseWherePointsAreJoined)
{
  const auto capsule = WithPointVectors(CapsuleFromRectangle(24, 12), Rotation);
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(capsule);
  filter->Update();
  EXPECT_EQ(Values(filter->GetOutput()->GetFieldData(), "BoundaryLength").size(), 0u);
  filter->JoinPointsOff();
  filter->Update();
  EXPECT_EQ(Values(filter->GetOutput()->GetFieldData(), "BoundaryLength").size(), 1u);
  vtkNew<vtkHodgeDecomposition> strict;
  strict->SetInputData(WithPointVectors(MoebiusStrip(12), Rotation));
  strict->StrictOn();
  Messages messages(strict);
  strict->Update();
  EXPECT_FALSE(messages.Error().empty());
}

TEST(HodgeDecomposition, PartsAreSwitched)
{
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(WithCellVectors(IrregularTorus(40, 20, 3), Rotation));
  filter->Update();
  const std::vector<double> all = Values(filter->GetOutput()->GetFieldData(), "FlowEnergies");
  filter->GradientPartOff();
  filter->RotationalPartOff();
  filter->HarmonicPartOff();
  filter->Update();
  vtkPolyData* const output = filter->GetPolyDataOutput();
  EXPECT_TRUE(output->GetPointData()->HasArray("Vorticity"));
  for (const char* const name : { "GradientPart", "RotationalPart", "HarmonicPart", "Potential", "StreamFunction" })
  {
    EXPECT_FALSE(output->GetPointData()->HasArray(name)) << name;
  }
  EXPECT_FALSE(output->GetFieldData()->HasArray("Solver")); // as nothing was solved for
  EXPECT_EQ(filter->GetNumberOfSolves(), 2);                // of the first run
  vtkNew<vtkHodgeDecomposition> derivatives;
  derivatives->SetInputData(filter->GetInput());
  derivatives->GradientPartOff();
  derivatives->RotationalPartOff();
  derivatives->HarmonicPartOff();
  derivatives->Update();
  EXPECT_TRUE(derivatives->GetOutput()->GetPointData()->HasArray("Divergence"));
  EXPECT_EQ(derivatives->GetNumberOfSetups(), 0);
  EXPECT_EQ(derivatives->GetNumberOfBases(), 0);
  EXPECT_EQ(derivatives->GetNumberOfSolves(), 0);
  EXPECT_EQ(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfCells(), 0);
  EXPECT_NEAR(Values(output->GetFieldData(), "FlowEnergies")[4], all[0], 1e-12 * all[0]);
  filter->HarmonicPartOn();
  filter->DerivativesOff();
  filter->Update();
  EXPECT_TRUE(output->GetPointData()->HasArray("HarmonicPart"));
  EXPECT_FALSE(output->GetPointData()->HasArray("Divergence"));
  EXPECT_NEAR(Values(output->GetFieldData(), "FlowEnergies")[3], all[3], 1e-9 * all[0]);
}

TEST(HodgeDecomposition, StreamlinesAreContoursOfTheStreamFunction)
{
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(WithCellVectors(Icosphere(4), Rotation));
  filter->SetNumberOfContours(5);
  filter->Update();
  vtkPolyData* const lines = vtkPolyData::SafeDownCast(filter->GetOutput(1));
  EXPECT_GT(lines->GetNumberOfLines(), 0);
  std::vector<double> heights{ -0.8, -0.4, 0.0, 0.4, 0.8 }; // circles of latitude
  for (vtkIdType point = 0; point < lines->GetNumberOfPoints(); ++point)
  {
    double nearest = 1.0;
    for (const double height : heights)
    {
      nearest = std::min(nearest, std::abs(PointOf(lines, point)[2] - height));
    }
    ASSERT_LT(nearest, 0.01);
  }
  filter->SetLift(0.1);
  filter->Update();
  EXPECT_NEAR(PointOf(lines, 0).norm(), 1.0 + 0.1 * 2.0 * std::sqrt(3.0), 0.02);
  filter->SetNumberOfContours(0);
  filter->Update();
  EXPECT_EQ(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfCells(), 0);
}

TEST(HodgeDecomposition, AFlowThatChangesIsDecomposedAgainAndASurfaceToo)
{
  vtkNew<vtkHodgeDecomposition> filter;
  for (int step = 1; step <= 3; ++step)
  {
    for (const int subdivisions : { 2, 3 })
    {
      const auto input =
        WithCellVectors(Icosphere(subdivisions), [step](const Vector3& p) { return Vector3(step * Rotation(p)); });
      filter->SetInputData(input);
      filter->Update();
      vtkNew<vtkHodgeDecomposition> fresh;
      fresh->SetInputData(input);
      fresh->Update();
      EXPECT_EQ(Values(filter->GetOutput()->GetPointData(), "StreamFunction"),
        Values(fresh->GetOutput()->GetPointData(), "StreamFunction"));
    }
  }
}

TEST(HodgeDecomposition, ShowsTheSurfaceWhereNoFlowIsChosen)
{
  const auto surface = PolyDataOf(Icosphere(1));
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(surface);
  Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("no flow to decompose"), std::string::npos) << messages.Error();
  EXPECT_NE(messages.Error().find("choose one"), std::string::npos) << messages.Error();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), surface->GetNumberOfCells());
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(filter->GetOutput(1)->GetNumberOfCells(), 0);
}

TEST(HodgeDecomposition, WhatIsWrongIsToldWithARemedy)
{
  const auto expectError = [](vtkPolyData* input, const std::string& part, const auto& prepare)
  {
    vtkNew<vtkHodgeDecomposition> filter;
    filter->SetInputData(input);
    prepare(filter.Get());
    Messages messages(filter);
    filter->Update();
    EXPECT_NE(messages.Error().find(part), std::string::npos) << messages.Error();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  };
  const auto surface = WithCellVectors(Icosphere(1), Rotation);
  expectError(surface, "Boundary is 2", [](vtkHodgeDecomposition* filter) { filter->SetBoundary(2); });
  expectError(surface, "Length Scale is 0", [](vtkHodgeDecomposition* filter) { filter->SetLengthScale(0.0); });
  expectError(surface, "is not among",
    [](vtkHodgeDecomposition* filter)
    { filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Wind"); });
  const auto components = PolyDataOf(Icosphere(1));
  components->GetCellData()->AddArray(Zeros("u", components->GetNumberOfCells(), 1));
  expectError(components, "choose both",
    [](vtkHodgeDecomposition* filter)
    { filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "u"); });
  expectError(components, "Axis is (0, 0, 0)",
    [](vtkHodgeDecomposition* filter)
    {
      filter->SetAxis(0.0, 0.0, 0.0);
      filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "u");
      filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "u");
    });
  surface->GetCellData()->GetVectors()->SetComponent(7, 1, 1e30);
  expectError(surface, "as fill values have", [](vtkHodgeDecomposition*) {});
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellData()->GetVectors()->SetComponent(cell, 1, std::nan(""));
  }
  expectError(surface, "nothing is left", [](vtkHodgeDecomposition*) {});
}

TEST(HodgeDecomposition, CellsWithoutAFlowTakeNoPart)
{
  const auto whole = WithCellVectors(Icosphere(2), Rotation);
  const auto land = WithCellVectors(Icosphere(2), Rotation);
  land->GetCellData()->GetVectors()->SetComponent(7, 1, std::nan(""));
  vtkNew<vtkHodgeDecomposition> filter;
  filter->SetInputData(land);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  vtkDataSet* const output = filter->GetOutput();
  EXPECT_EQ(Values(output->GetFieldData(), "CellsWithoutFlow"), std::vector<double>{ 1.0 });
  EXPECT_EQ(Values(output->GetFieldData(), "BoundaryPoint").size(), 1u);
  const std::vector<double> parts = Values(output->GetCellData(), "RotationalPart");
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    EXPECT_EQ(std::isnan(parts[k]), k / 3 == 7) << k;
  }
}

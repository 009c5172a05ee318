// Features that a surface has by itself, and the rotation against all that is followed.

#include "vtkHarmonicFieldSolver.h"

#include "NoteOfShear.h"
#include "TestTools.h"

#include "vtkDoubleArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr double Degree = Pi / 180.0;

vtkSmartPointer<vtkHarmonicFieldSolver> NewSolver(vtkPolyData* input, int N)
{
  auto solver = vtkSmartPointer<vtkHarmonicFieldSolver>::New();
  solver->SetInputData(input);
  solver->SetNumberOfDirections(N);
  solver->AllDirectionsOn();
  solver->SetTolerance(1e-12);
  return solver;
}

Vector3 Centre(vtkPolyData* surface, vtkIdType cell)
{
  vtkIdType size;
  const vtkIdType* corners;
  surface->GetCellPoints(cell, size, corners);
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    sum += Vector3(surface->GetPoint(corners[k])) / 3.0;
  }
  return sum;
}

/// Calls check(centre, a direction) for each cell.
template <class Check>
void ForDirections(vtkHarmonicFieldSolver* solver, const Check& check, int k = 0)
{
  vtkPolyData* const output = solver->GetPolyDataOutput();
  ASSERT_GT(output->GetNumberOfCells(), 0);
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    SCOPED_TRACE("cell " + std::to_string(cell));
    check(Centre(output, cell), Tuple(output->GetCellData(), "Direction" + std::to_string(k), cell));
  }
}

std::vector<Complex> Powers(vtkHarmonicFieldSolver* solver)
{
  std::vector<Complex> powers;
  const auto values = Values(solver->GetOutput()->GetCellData(), "PowerField");
  for (std::size_t i = 0; i + 1 < values.size(); i += 2)
  {
    powers.emplace_back(values[i], values[i + 1]);
  }
  return powers;
}

double Largest(const std::vector<Complex>& a, const std::vector<Complex>& b, Complex factor)
{
  double largest = a.size() == b.size() && !a.empty() ? 0.0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - factor * b[i]));
  }
  return largest;
}

void Fill(vtkDataSetAttributes* attributes, const std::string& name, vtkIdType size, double value)
{
  const auto array = Zeros(name, size, 1);
  array->Fill(value);
  attributes->AddArray(array);
}

std::string ErrorOf(vtkHarmonicFieldSolver* solver)
{
  const Messages messages(solver);
  solver->Update();
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 0);
  return messages.Error();
}

std::vector<std::string> WarningsOf(vtkHarmonicFieldSolver* solver)
{
  const Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.GetErrors().empty());
  return WithoutNoteOfShear(messages.GetWarnings());
}

TEST(Features, VectorsFollowTheBoundaryCounterClockwise)
{
  const auto disk = PolyDataOf(Disk(8));
  for (const int kind :
    { vtkHarmonicFieldSolver::PowerField, vtkHarmonicFieldSolver::FaceField, vtkHarmonicFieldSolver::OneForm })
  {
    for (const int constraints : { vtkHarmonicFieldSolver::Soft, vtkHarmonicFieldSolver::Hard })
    {
      const auto solver = NewSolver(disk, 1);
      solver->SetDiscretisation(kind);
      solver->SetConstraintType(constraints);
      solver->SetBoundaryWeight(1.0);
      EXPECT_TRUE(WarningsOf(solver).empty());
      const bool isPower = kind == vtkHarmonicFieldSolver::PowerField;
      ForDirections(solver,
        [isPower](const Vector3& centre, const Vector3& direction)
        {
          if (isPower || centre.norm() > 0.9) // flows end up curl-free in the middle
          {
            EXPECT_GT(centre.normalized().cross(direction)[2], 0.9);
          }
        });
      solver->SetRotation(180.0);
      solver->Update();
      ForDirections(solver,
        [](const Vector3& centre, const Vector3& direction)
        {
          if (centre.norm() > 0.9)
          {
            EXPECT_LT(centre.normalized().cross(direction)[2], -0.9);
          }
        });
      solver->SetRotation(90.0); // counter-clockwise: towards the inside
      solver->Update();
      ForDirections(solver,
        [](const Vector3& centre, const Vector3& direction)
        {
          if (centre.norm() > 0.9)
          {
            EXPECT_LT(centre.dot(direction), 0.0);
          }
        });
    }
  }
}

/// The field of least energy on the unit disc that follows its boundary is c r^4 times its 4th power, with
/// 4 c = (1 - c) 30 / sqrt(pi) from the balance of both energies at the boundary.
TEST(Features, WeightsMeanTheSameAtAnyResolution)
{
  for (const double weight : { 0.3, 1.0, 10.0 })
  {
    const double c = 1.0 / (1.0 + 4.0 * std::sqrt(Pi) / (30.0 * weight));
    std::vector<double> ratios;
    for (const int rings : { 12, 24 })
    {
      const auto solver = NewSolver(PolyDataOf(Disk(rings)), 4);
      solver->SetBoundaryWeight(weight);
      solver->Update();
      const auto powers = Powers(solver);
      double found = 0.0, expected = 0.0;
      for (std::size_t cell = 0; cell < powers.size(); ++cell)
      {
        found += std::abs(powers[cell]);
        expected += c * std::pow(Centre(solver->GetPolyDataOutput(), cell).norm(), 4);
      }
      ratios.push_back(found / expected);
    }
    EXPECT_NEAR(ratios[0], 1.0, 0.2) << weight;
    EXPECT_NEAR(2.0 * ratios[1] - ratios[0], 1.0, 0.02) << weight; // with edges of no length
  }
}

TEST(Features, WeightsMeanTheSameAtAnySize)
{
  std::vector<std::vector<Complex>> powers;
  for (const double scale : { 1.0, 1000.0 })
  {
    Surface surface = IrregularTorus(40, 20, 3);
    surface.V *= scale;
    const auto solver = NewSolver(PolyDataOf(surface), 4);
    solver->SetCurvatureWeight(1.0);
    solver->SetSharpEdgesWeight(1.0);
    solver->SetFeatureAngle(20.0);
    solver->Update();
    powers.push_back(Powers(solver));
  }
  EXPECT_LT(Largest(powers[0], powers[1], 1.0), 1e-8);
}

TEST(Features, CrossesLinesAndHexagonsFollowPrincipalDirections)
{
  const auto torus = PolyDataOf(Torus(60, 30));
  const auto around = [](const Vector3& p) { return Vector3(-p[1], p[0], 0.0).normalized(); };
  for (const int N : { 2, 4, 6, 8 })
  {
    for (const int which : { vtkHarmonicFieldSolver::MaximumCurvature, vtkHarmonicFieldSolver::MinimumCurvature })
    {
      SCOPED_TRACE("N " + std::to_string(N));
      const auto solver = NewSolver(torus, N);
      solver->SetCurvatureWeight(10.0);
      solver->SetCurvatureDirection(which);
      EXPECT_TRUE(WarningsOf(solver).empty());
      // The maximum goes along the small circles. An angle from it, of N directions, is that of N-th powers.
      const bool isMaximum = which == vtkHarmonicFieldSolver::MaximumCurvature;
      ForDirections(solver,
        [&](const Vector3& centre, const Vector3& direction)
        {
          const double angle = std::acos(std::min(1.0, std::abs(direction.dot(around(centre)))));
          const double fromIt = isMaximum ? angle - 0.5 * Pi : angle;
          EXPECT_GT(std::cos(N * fromIt), std::cos(N * 5.0 * Degree));
        });
    }
  }
}

TEST(Features, CrossesFollowTheEdgesOfABox)
{
  Surface cube;
  cube.V.resize(8, 3);
  for (int i = 0; i < 8; ++i)
  {
    cube.V.row(i) << (i & 1), ((i >> 1) & 1), ((i >> 2) & 1);
  }
  cube.F.resize(12, 3);
  cube.F << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5;
  const auto box = PolyDataOf(Subdivide(Subdivide(Subdivide(cube))));
  for (const auto& [kind, constraints] :
    std::vector<std::pair<int, int>>{ { vtkHarmonicFieldSolver::PowerField, vtkHarmonicFieldSolver::Soft },
      { vtkHarmonicFieldSolver::PowerField, vtkHarmonicFieldSolver::Hard },
      { vtkHarmonicFieldSolver::PointPowerField, vtkHarmonicFieldSolver::Soft },
      { vtkHarmonicFieldSolver::PointPowerField, vtkHarmonicFieldSolver::Hard } })
  {
    const auto solver = NewSolver(box, 4);
    solver->SetDiscretisation(kind);
    solver->SetConstraintType(constraints);
    solver->SetSharpEdgesWeight(1.0);
    EXPECT_TRUE(WarningsOf(solver).empty());
    // Their 4th power is the same all over the box, whose corners are quarter turns. At points, the quarter turn of a corner is
    // spread over the triangles there, where the field is zero.
    const bool isAtPoints = kind == vtkHarmonicFieldSolver::PointPowerField;
    const double tolerance = isAtPoints ? 2e-3 : 1e-9;
    const auto isAtCorner = [isAtPoints](const Vector3& centre)
    { return isAtPoints && ((centre.array() - 0.5).abs() > 0.35).all(); };
    ForDirections(solver,
      [&](const Vector3& centre, const Vector3& direction)
      { EXPECT_NEAR(isAtCorner(centre) ? 1.0 : direction.cwiseAbs().maxCoeff(), 1.0, tolerance); });
    solver->SetRotation(30.0);
    solver->Update();
    const double turned = std::cos(30.0 * Degree);
    ForDirections(solver,
      [&](const Vector3& centre, const Vector3& direction)
      { EXPECT_NEAR(isAtCorner(centre) ? turned : direction.cwiseAbs().maxCoeff(), turned, tolerance); });
    solver->SetFeatureAngle(91.0);
    const auto warnings = WarningsOf(solver);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("Feature Angle"), std::string::npos);
  }
}

TEST(Features, RotationTurnsAllThatIsFollowedByItsAngle)
{
  for (const int N : { 1, 2, 4, 5, 6 })
  {
    SCOPED_TRACE("N " + std::to_string(N));
    const auto surface = PolyDataOf(Disk(8));
    AddCellVectors(surface, "Given", { { 10, { 1.0, 0.5, 0.0 } }, { 200, { -0.5, 0.25, 0.0 } } });
    Fill(surface->GetCellData(), "OnCells", surface->GetNumberOfCells(), 30.0);
    Fill(surface->GetPointData(), "OnPoints", surface->GetNumberOfPoints(), 30.0);
    const auto guide = PolyDataOf(Disk(1)); // points near the surface
    AddPointVectors(guide, "Wind", { { 2, { 0.2, 1.0, 0.0 } } });

    const auto solver = NewSolver(surface, N);
    solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
    solver->AddInputDataObject(1, guide);
    solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "Wind");
    solver->SetBoundaryWeight(0.2);
    solver->Update();
    const auto straight = Powers(solver);
    solver->SetRotation(45.0);
    solver->Update();
    const auto turned = Powers(solver);
    EXPECT_LT(Largest(turned, straight, std::polar(1.0, N * 45.0 * Degree)), 1e-9);

    solver->SetRotation(15.0);
    for (const int association : { OnCells, OnPoints })
    {
      solver->SetInputArrayToProcess(4, 0, 0, association, association == OnCells ? "OnCells" : "OnPoints");
      solver->Update();
      EXPECT_LT(Largest(Powers(solver), turned, 1.0), 1e-9);
    }
    EXPECT_EQ(solver->GetNumberOfSystems(), 1); // another value, nothing more
  }
}

/// Fibres of a plate whose angle against the x-axis changes along it.
TEST(Features, RotationArraysTurnTheFieldHereMoreThanThere)
{
  const auto plate = PolyDataOf(PlaneGrid(20, 4));
  const auto axis = Zeros("Axis", plate->GetNumberOfCells(), 3);
  axis->FillComponent(0, 1.0);
  plate->GetCellData()->AddArray(axis);
  const auto onCells = Zeros("Angle", plate->GetNumberOfCells(), 1);
  for (vtkIdType cell = 0; cell < plate->GetNumberOfCells(); ++cell)
  {
    onCells->SetValue(cell, 4.0 * Centre(plate, cell)[0]);
  }
  plate->GetCellData()->AddArray(onCells);
  const auto onPoints = Zeros("Angle", plate->GetNumberOfPoints(), 1);
  for (vtkIdType point = 0; point < plate->GetNumberOfPoints(); ++point)
  {
    onPoints->SetValue(point, 4.0 * plate->GetPoint(point)[0]);
  }
  plate->GetPointData()->AddArray(onPoints);
  const auto axisOfPoints = Zeros("Axis", plate->GetNumberOfPoints(), 3);
  axisOfPoints->FillComponent(0, 1.0);
  plate->GetPointData()->AddArray(axisOfPoints);
  for (const auto& [kind, association] :
    std::vector<std::pair<int, int>>{ { vtkHarmonicFieldSolver::PowerField, OnCells },
      { vtkHarmonicFieldSolver::PowerField, OnPoints }, { vtkHarmonicFieldSolver::PointPowerField, OnPoints } })
  {
    const auto solver = NewSolver(plate, 2);
    solver->SetDiscretisation(kind);
    solver->SetInputArrayToProcess(1, 0, 0, kind == vtkHarmonicFieldSolver::PowerField ? OnCells : OnPoints, "Axis");
    solver->SetInputArrayToProcess(4, 0, 0, association, "Angle");
    solver->SetAlignment(1e6);
    solver->Update();
    ForDirections(solver,
      [](const Vector3& centre, const Vector3& direction)
      {
        const double angle = 4.0 * centre[0] * Degree;
        EXPECT_NEAR(std::abs(direction[0] * std::sin(angle) - direction[1] * std::cos(angle)), 0.0, 1e-4);
      });
  }
}

TEST(Features, WhatCannotBeFollowedIsAWarningAndTheSmoothestFieldComes)
{
  const auto sphere = PolyDataOf(Icosphere(3));
  const auto solver = NewSolver(sphere, 1);
  solver->SetTolerance(1e-6);
  solver->SetBoundaryWeight(1.0);
  auto warnings = WarningsOf(solver);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("no boundary"), std::string::npos);
  ForDirections(solver, [](const Vector3&, const Vector3& direction) { EXPECT_NEAR(direction.norm(), 1.0, 1e-9); });

  solver->SetBoundaryWeight(0.0);
  solver->SetCurvatureWeight(1.0);
  warnings = WarningsOf(solver);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("a field of 1 direction cannot follow"), std::string::npos);
}

TEST(Features, ARotationAgainstNothingIsAWarning)
{
  const auto sphere = PolyDataOf(Icosphere(3));
  Fill(sphere->GetCellData(), "Angle", sphere->GetNumberOfCells(), 30.0);
  for (const bool isArray : { false, true })
  {
    const auto solver = NewSolver(sphere, 4);
    EXPECT_TRUE(WarningsOf(solver).empty());
    isArray ? solver->SetInputArrayToProcess(4, 0, 0, OnCells, "Angle") : solver->SetRotation(30.0);
    const auto warnings = WarningsOf(solver);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("Rotation and Rotation Array have no effect"), std::string::npos);
    solver->SetCurvatureWeight(1.0);
    solver->SetCurvatureScale(1.0); // at which the triangles count
    EXPECT_TRUE(WarningsOf(solver).empty());
  }
}

TEST(Features, FunctionsFollowNone)
{
  const auto plate = PolyDataOf(PlaneGrid(6, 6));
  const auto values = Zeros("Height", plate->GetNumberOfPoints(), 1);
  values->SetValue(0, 1.0);
  plate->GetPointData()->AddArray(values);
  const auto solver = NewSolver(plate, 4);
  solver->SetDiscretisation(vtkHarmonicFieldSolver::ScalarFunction);
  solver->SetInputArrayToProcess(3, 0, 0, OnPoints, "Height");
  solver->Update();
  const auto without = Values(solver->GetOutput()->GetPointData(), "ScalarFunction");
  solver->SetBoundaryWeight(1.0);
  solver->SetCurvatureWeight(1.0);
  solver->SetRotation(20.0);
  EXPECT_TRUE(WarningsOf(solver).empty());
  EXPECT_EQ(Values(solver->GetOutput()->GetPointData(), "ScalarFunction"), without);
}

TEST(Features, NameWhatIsWrong)
{
  const auto torus = PolyDataOf(Torus(20, 10));
  const auto solver = NewSolver(torus, 4);
  solver->SetBoundaryWeight(-1.0);
  EXPECT_NE(ErrorOf(solver).find("Boundary Weight is -1"), std::string::npos);
  solver->SetBoundaryWeight(0.0);
  solver->SetCurvatureWeight(1.0);
  solver->SetConstraintType(vtkHarmonicFieldSolver::Hard);
  EXPECT_NE(ErrorOf(solver).find("set Constraint Type to Soft"), std::string::npos);
  solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  solver->SetInputArrayToProcess(4, 0, 0, OnCells, "Nowhere");
  EXPECT_NE(ErrorOf(solver).find("'Nowhere', chosen for the rotation"), std::string::npos);
  Fill(torus->GetCellData(), "Angle", torus->GetNumberOfCells(), 0.0);
  torus->GetCellData()->GetArray("Angle")->SetComponent(7, 0, std::numeric_limits<double>::quiet_NaN());
  solver->SetInputArrayToProcess(4, 0, 0, OnCells, "Angle");
  EXPECT_NE(ErrorOf(solver).find("the rotation at cell 7 is not finite"), std::string::npos);
  torus->GetCellData()->GetArray("Angle")->SetComponent(7, 0, 5.0);
  torus->GetCellData()->GetArray("Angle")->Modified();
  torus->Modified();
  EXPECT_TRUE(WarningsOf(solver).empty());
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 400);
}

}

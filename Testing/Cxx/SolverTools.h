#ifndef dmgSolverTools_h
#define dmgSolverTools_h

#include "TestTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkHarmonicFieldSolver.h"
#include "vtkIntArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

/// A solver on a sphere, and what it gives.
namespace dmg::test
{

using Solver = vtkHarmonicFieldSolver;

inline constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
inline constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// Follows the array Given of cells, and gives all directions.
inline vtkSmartPointer<Solver> NewSolver(vtkPolyData* input, int discretisation = Solver::PointPowerField)
{
  auto solver = vtkSmartPointer<Solver>::New();
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  solver->SetDiscretisation(discretisation);
  solver->SetTolerance(1e-8);
  solver->AllDirectionsOn();
  return solver;
}

/// A sphere on which two cells are prescribed, of 1280 faces unless said otherwise.
inline vtkSmartPointer<vtkPolyData> Sphere(int subdivisions = 3)
{
  auto input = PolyDataOf(Icosphere(subdivisions));
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 200, { -0.5, 0.25, 1.0 } } });
  return input;
}

/// Of a surface with few faces, three levels at most.
inline vtkSmartPointer<vtkDirectionalProlongation> NewProlongation(vtkPolyData* input)
{
  auto prolongation = vtkSmartPointer<vtkDirectionalProlongation>::New();
  prolongation->SetInputData(input);
  prolongation->SetMinimumNumberOfFaces(60);
  prolongation->SetMaximumNumberOfCoarseLevels(2);
  return prolongation;
}

/// The sphere with all operators of three levels.
inline vtkSmartPointer<vtkPolyData> SphereWithOperators()
{
  const auto prolongation = NewProlongation(Sphere());
  prolongation->FaceFieldsOn();
  prolongation->OneFormsOn();
  prolongation->Update();
  return prolongation->GetPolyDataOutput();
}

inline vtkPolyData* Edges(Solver* solver)
{
  return vtkPolyData::SafeDownCast(solver->GetOutputDataObject(1));
}

inline vtkTable* Convergence(Solver* solver)
{
  return vtkTable::SafeDownCast(solver->GetOutputDataObject(2));
}

inline int Converged(Solver* solver)
{
  return vtkIntArray::SafeDownCast(solver->GetOutput()->GetFieldData()->GetAbstractArray("Converged"))->GetValue(0);
}

inline std::vector<double> CellValues(Solver* solver, const std::string& name)
{
  return Values(solver->GetOutput()->GetCellData(), name);
}

/// The numbers that a field of any kind is made of.
inline std::vector<double> Unknowns(Solver* solver)
{
  switch (solver->GetDiscretisation())
  {
    case Solver::OneForm:
      return Values(Edges(solver)->GetCellData(), "OneForm");
    case Solver::FaceField:
      return CellValues(solver, "FaceField");
    case Solver::PointPowerField:
      return Values(solver->GetOutput()->GetPointData(), "PowerField");
    default:
      return CellValues(solver, "PowerField");
  }
}

/// Largest difference of two arrays, over the largest entry of the second.
inline double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference = a.size() == b.size() && !b.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  double scale = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    scale = std::max(scale, std::abs(b[i]));
  }
  return difference / scale;
}

using Counts = std::array<int, 3>; // set-ups, systems, solves

inline Counts CountsOf(Solver* solver)
{
  return { solver->GetNumberOfSetups(), solver->GetNumberOfSystems(), solver->GetNumberOfSolves() };
}

inline void ExpectEmpty(Solver* solver)
{
  EXPECT_EQ(solver->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(solver->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(Edges(solver)->GetNumberOfCells(), 0);
  EXPECT_EQ(Convergence(solver)->GetNumberOfColumns(), 0);
}

/// The two discretisations whose unknowns are vectors, not powers.
class VectorField : public testing::TestWithParam<int>
{
};

/// All three.
class AnyField : public VectorField
{
};

}

#endif

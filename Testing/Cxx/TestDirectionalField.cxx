// Directional Field: the solver, lines and singularities in one filter.

#include "SolverTools.h"
#include "TestTools.h"

#include "vtkDirectionalField.h"
#include "vtkFieldLines.h"
#include "vtkFieldSingularities.h"
#include "vtkVariant.h"

#include <utility>

namespace
{

using namespace dmg::test;

void ExpectSame(vtkPolyData* data, vtkPolyData* expected)
{
  ASSERT_EQ(data->GetNumberOfPoints(), expected->GetNumberOfPoints());
  ASSERT_EQ(data->GetNumberOfCells(), expected->GetNumberOfCells());
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* const arrays = expected->GetAttributes(kind);
    ASSERT_EQ(data->GetAttributes(kind)->GetNumberOfArrays(), arrays->GetNumberOfArrays());
    for (int index = 0; index < arrays->GetNumberOfArrays(); ++index)
    {
      const char* const name = arrays->GetArrayName(index);
      vtkDataArray* const array = data->GetAttributes(kind)->GetArray(name);
      ASSERT_TRUE(array) << name;
      for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
      {
        ASSERT_EQ(array->GetVariantValue(value), arrays->GetArray(name)->GetVariantValue(value)) << name;
      }
    }
  }
}

/// Sets the same properties of a solver and of what is derived of it.
void Prescribe(vtkHarmonicFieldSolver* solver, vtkPolyData* surface, int discretisation, int N)
{
  solver->SetInputData(surface);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  solver->SetDiscretisation(discretisation);
  solver->SetNumberOfDirections(N);
}

vtkSmartPointer<vtkPolyData> SphereWithDirections()
{
  const auto surface = PolyDataOf(Icosphere(3));
  AddCellVectors(surface, "Given", { { 12, { 1.0, 1.0, 0.0 } }, { 700, { 0.0, 1.0, 1.0 } } });
  return surface;
}

}

TEST(DirectionalField, ShowsWhatItsPartsShow)
{
  for (const auto& [discretisation, N] :
    { std::pair(vtkHarmonicFieldSolver::PowerField, 4), std::pair(vtkHarmonicFieldSolver::PowerField, 1),
      std::pair(vtkHarmonicFieldSolver::FaceField, 1), std::pair(vtkHarmonicFieldSolver::OneForm, 1) })
  {
    const auto surface = SphereWithDirections();
    vtkNew<vtkDirectionalField> whole;
    Prescribe(whole, surface, discretisation, N);
    whole->SetLineDistance(0.05);
    whole->SetSphereRadius(0.04);
    whole->Update();

    vtkNew<vtkHarmonicFieldSolver> solver;
    Prescribe(solver, surface, discretisation, N);
    vtkNew<vtkFieldLines> lines;
    lines->SetInputConnection(solver->GetOutputPort());
    lines->SetSeparatingDistance(0.05);
    vtkNew<vtkFieldSingularities> singularities;
    singularities->SetInputConnection(solver->GetOutputPort());
    singularities->SetSphereRadius(0.04);
    lines->Update();
    singularities->Update();
    ExpectSame(vtkPolyData::SafeDownCast(whole->GetOutputDataObject(0)),
      vtkPolyData::SafeDownCast(solver->GetOutputDataObject(0)));
    ExpectSame(vtkPolyData::SafeDownCast(whole->GetOutputDataObject(1)), lines->GetOutput());
    ExpectSame(vtkPolyData::SafeDownCast(whole->GetOutputDataObject(2)), singularities->GetOutput(3));
    EXPECT_GT(lines->GetOutput()->GetNumberOfLines(), 10);
    // Arrow heads are lines of their own, each with the seed of the line that it ends.
    double seeds[2];
    lines->GetOutput()->GetCellData()->GetArray("Seed")->GetRange(seeds);
    EXPECT_EQ(lines->GetOutput()->GetNumberOfLines() > seeds[1] + 1.0, N == 1);
    EXPECT_EQ(lines->GetOutput()->GetNumberOfPolys(), 0); // VTK 9.1 averages no cells of lines and polygons
  }
}

TEST(DirectionalField, KeepsTheStagesOfTheSolver)
{
  vtkNew<vtkDirectionalField> field;
  Prescribe(field, SphereWithDirections(), vtkHarmonicFieldSolver::PowerField, 4);
  field->Update();
  const auto before = field->GetOutputDataObject(1)->GetMTime();
  field->SetLineDistance(0.03);
  field->Update();
  EXPECT_NE(field->GetOutputDataObject(1)->GetMTime(), before);
  EXPECT_EQ(field->GetNumberOfSolves(), 1);
}

TEST(DirectionalField, RefusesWhatItsPartsRefuse)
{
  vtkNew<vtkDirectionalField> field;
  Prescribe(field, SphereWithDirections(), vtkHarmonicFieldSolver::PowerField, 4);
  field->SetLineDistance(2.0);
  Messages messages(field);
  field->Update();
  EXPECT_NE(messages.Error().find("Line Distance is 2"), std::string::npos) << messages.Error();
  messages.Forget();
  field->SetLineDistance(0.1);
  field->SetInputArrayToProcess(1, 0, 0, OnCells, "Nowhere");
  field->Update();
  EXPECT_NE(messages.Error().find("Nowhere"), std::string::npos) << messages.Error();
  for (int port = 0; port < 3; ++port)
  {
    EXPECT_EQ(field->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::CELL), 0);
  }
}

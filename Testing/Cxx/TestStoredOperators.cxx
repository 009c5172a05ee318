// Operators that a solver finds in the field data of its input.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkIntArray.h"
#include "vtkReverseSense.h"
#include "vtkTable.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

using namespace dmg;
using namespace dmg::test;

TEST(StoredOperators, AreUsedAfterWritingAndReading)
{
  const std::string path = testing::TempDir() + "StoredOperators.vtp";
  const auto input = SphereWithOperators();
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(input);
  writer->SetDataModeToBinary(); // see Testing/Examples/README.md, "Files"
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  std::remove(path.c_str());

  const auto before = NewSolver(input), after = NewSolver(reader->GetOutput());
  for (vtkHarmonicFieldSolver* solver : { before.Get(), after.Get() })
  {
    solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
    solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
    solver->Update();
    EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 3u);
  }
  EXPECT_EQ(CellValues(before, "PowerField"), CellValues(after, "PowerField"));
}

TEST(StoredOperators, ChangeNothingWhereTheSolverTakesSamples)
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  const auto bare = PolyDataOf(IrregularSphere(4, 5));
  AddCellVectors(bare, "Given", { { 10, { 1.0, 0.5, -0.25 } } });
  prolongation->SetInputData(bare);
  prolongation->Update();
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(prolongation->GetOutput());
  double point[3];
  moved->GetPoint(5, point);
  moved->GetPoints()->SetPoint(5, 1.001 * point[0], 1.001 * point[1], 1.001 * point[2]);
  for (int kind :
    { vtkHarmonicFieldSolver::Automatic, vtkHarmonicFieldSolver::ConjugateGradients, vtkHarmonicFieldSolver::Cholesky })
  {
    const auto without = NewSolver(bare), with = NewSolver(prolongation->GetPolyDataOutput()), stale = NewSolver(moved);
    const Messages messages(stale);
    for (vtkHarmonicFieldSolver* solver : { without.Get(), with.Get(), stale.Get() })
    {
      solver->SetSolver(kind);
      solver->Update();
    }
    EXPECT_EQ(CellValues(with, "PowerField"), CellValues(without, "PowerField"));
    EXPECT_TRUE(messages.Silent());
    EXPECT_EQ(stale->GetOutput()->GetNumberOfCells(), bare->GetNumberOfCells());
  }
}

// Stored operators are in the frames of the cells, and the solver sees the surface from outside.
TEST(StoredOperators, AreThoseOfTheSameSurfaceFromInside)
{
  for (const int kind : { vtkHarmonicFieldSolver::PowerField, vtkHarmonicFieldSolver::PointPowerField,
         vtkHarmonicFieldSolver::FaceField, vtkHarmonicFieldSolver::OneForm })
  {
    std::vector<double> fields[2];
    std::size_t iterations[2];
    for (const int isInside : { 0, 1 })
    {
      vtkNew<vtkPolyData> sphere;
      sphere->DeepCopy(Sphere());
      if (isInside)
      {
        vtkNew<vtkReverseSense> reversed;
        reversed->SetInputData(sphere);
        reversed->Update();
        sphere->DeepCopy(reversed->GetOutput());
      }
      const auto prolongation = NewProlongation(sphere);
      prolongation->FaceFieldsOn();
      prolongation->OneFormsOn();
      prolongation->Update();
      const auto solver = NewSolver(prolongation->GetPolyDataOutput());
      solver->SetDiscretisation(kind);
      solver->SetNumberOfDirections(1);
      solver->SetRotation(30.0);
      solver->SetTolerance(1e-10);
      solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
      solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
      solver->Update();
      fields[isInside] = Values(solver->GetOutput()->GetCellData(), "Direction0");
      iterations[isInside] = Convergence(solver)->GetNumberOfRows();
    }
    ASSERT_EQ(fields[0].size(), fields[1].size());
    for (std::size_t i = 0; i < fields[0].size(); ++i)
    {
      ASSERT_NEAR(fields[0][i], fields[1][i], 1e-6) << kind;
    }
    EXPECT_NEAR(static_cast<double>(iterations[0]), static_cast<double>(iterations[1]), 3.0) << kind;
  }
}

TEST(StoredOperators, OfAnotherSurfaceAreRefused)
{
  const auto input = SphereWithOperators();
  const auto solver = NewSolver(input);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  Messages messages(solver);
  solver->Update();
  ASSERT_TRUE(messages.Silent());
  double point[3];
  input->GetPoint(5, point);
  input->GetPoints()->SetPoint(5, 1.001 * point[0], 1.001 * point[1], 1.001 * point[2]);
  input->GetPoints()->Modified();
  input->Modified();
  solver->Update();
  EXPECT_NE(messages.Error().find("apply Directional Prolongation (vtkDirectionalProlongation)"), std::string::npos)
    << messages.Error();
  ExpectEmpty(solver);
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));

  // As soon as the surface is the old one again, nothing has to be redone.
  input->GetPoints()->SetPoint(5, point);
  input->GetPoints()->Modified();
  input->Modified();
  messages.Forget();
  solver->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
}

namespace
{

struct Damage
{
  std::string Name;
  std::string Array; ///< that is damaged and that the message must name
  std::function<void(vtkFieldData*, vtkAbstractArray*)> Do;
};

std::ostream& operator<<(std::ostream& os, const Damage& damage)
{
  return os << damage.Name;
}

class DamagedOperators : public testing::TestWithParam<Damage>
{
};

void SetInt(vtkAbstractArray* array, vtkIdType i, int value)
{
  vtkIntArray::SafeDownCast(array)->SetValue(i, value);
}

void Shorten(vtkAbstractArray* array)
{
  array->Resize(array->GetNumberOfTuples() - 1);
}

const Damage Damages[] = {
  { "Missing", "Prolongation.SP.1.Columns",
    [](vtkFieldData* data, vtkAbstractArray* array) { data->RemoveArray(array->GetName()); } },
  { "WithoutFormat", "Prolongation.Format",
    [](vtkFieldData* data, vtkAbstractArray* array) { data->RemoveArray(array->GetName()); } },
  { "OtherFormat", "Prolongation.Format",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, 1); } }, // before 1-forms and face fields
  { "WithoutDigest", "Prolongation.Digest",
    [](vtkFieldData* data, vtkAbstractArray* array) { data->RemoveArray(array->GetName()); } },
  { "OptionsNotNumbers", "Prolongation.Options",
    [](vtkFieldData*, vtkAbstractArray* array)
    { vtkDoubleArray::SafeDownCast(array)->SetValue(1, std::numeric_limits<double>::quiet_NaN()); } },
  { "OtherSize", "Prolongation.NumbersOfFaces",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, 1281); } },
  { "SizesThatGrow", "Prolongation.NumbersOfVertices",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 2, 100000); } },
  { "SizeOfNothing", "Prolongation.NumbersOfFaces",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 2, -5); } },
  { "LevelsThatDiffer", "Prolongation.NumbersOfVertices",
    [](vtkFieldData*, vtkAbstractArray* array) { Shorten(array); } },
  { "OffsetsTooFew", "Prolongation.S0.0.Offsets", [](vtkFieldData*, vtkAbstractArray* array) { Shorten(array); } },
  { "OffsetsThatFall", "Prolongation.Nodal.0.Offsets",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 7, 1000000); } },
  { "OffsetsNotFromZero", "Prolongation.Nodal.1.Offsets",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, -1); } },
  { "ColumnTooLarge", "Prolongation.SP.0.Columns",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 11, 1000000); } },
  { "ColumnNegative", "Prolongation.S0.1.Columns",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, -1); } },
  { "ColumnsTooFew", "Prolongation.SP.0.Offsets", // they no longer end where the columns do
    [](vtkFieldData* data, vtkAbstractArray*) { Shorten(data->GetAbstractArray("Prolongation.SP.0.Columns")); } },
  { "ValuesTooFew", "Prolongation.SP.0.Values", [](vtkFieldData*, vtkAbstractArray* array) { Shorten(array); } },
  { "ValueNotANumber", "Prolongation.Nodal.0.Values",
    [](vtkFieldData*, vtkAbstractArray* array)
    { vtkDoubleArray::SafeDownCast(array)->SetValue(3, std::numeric_limits<double>::quiet_NaN()); } },
  { "ValueWithoutWeight", "Prolongation.S0.0.Values",
    [](vtkFieldData*, vtkAbstractArray* array) { vtkDoubleArray::SafeDownCast(array)->SetValue(3, 7.0); } },
  { "OtherType", "Prolongation.SP.0.Values",
    [](vtkFieldData* data, vtkAbstractArray* array)
    {
      vtkNew<vtkIntArray> other;
      other->SetName(array->GetName());
      data->AddArray(other);
    } },
};

}

TEST_P(DamagedOperators, AreRefusedByName)
{
  vtkNew<vtkPolyData> input;
  input->DeepCopy(SphereWithOperators());
  vtkFieldData* const data = input->GetFieldData();
  ASSERT_TRUE(data->HasArray(GetParam().Array.c_str()));
  GetParam().Do(data, data->GetAbstractArray(GetParam().Array.c_str()));
  const auto solver = NewSolver(input);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  const Messages messages(solver);
  solver->Update();
  EXPECT_NE(messages.Error().find("'" + GetParam().Array + "'"), std::string::npos) << messages.Error();
  EXPECT_NE(messages.Error().find("vtkDirectionalProlongation"), std::string::npos);
  ExpectEmpty(solver);
}

INSTANTIATE_TEST_SUITE_P(StoredOperators, DamagedOperators, testing::ValuesIn(Damages),
  [](const testing::TestParamInfo<Damage>& info) { return info.param.Name; });

TEST_P(VectorField, OfStoredOperatorsIsThatOfTheOriginalsToTheBit)
{
  const std::string path = testing::TempDir() + "StoredOperators" + std::to_string(GetParam()) + ".vtp";
  const auto input = SphereWithOperators();
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(input);
  writer->SetDataModeToBinary(); // see Testing/Examples/README.md, "Files"
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  std::remove(path.c_str());
  const auto before = NewSolver(input, GetParam());
  const auto after = NewSolver(reader->GetOutput(), GetParam());
  for (Solver* solver : { before.Get(), after.Get() })
  {
    solver->SetSolver(Solver::ConjugateGradients);
    solver->SetCoarseSpace(Solver::StructurePreserving);
    solver->Update();
    EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 3u);
  }
  EXPECT_EQ(Unknowns(before), Unknowns(after));
}

TEST_P(AnyField, NamesThePropertyThatMissingOperatorsTake)
{
  const auto prolongation = NewProlongation(Sphere());
  prolongation->PowerFieldsOff();
  const auto solver = NewSolver(nullptr, GetParam());
  solver->SetInputConnection(prolongation->GetOutputPort());
  solver->SetSolver(Solver::ConjugateGradients);
  solver->SetCoarseSpace(Solver::StructurePreserving);
  Messages messages(solver);
  solver->Update();
  if (GetParam() == Solver::PointPowerField)
  {
    EXPECT_TRUE(messages.Silent()) << messages.Error(); // S0 is always there
    EXPECT_EQ(solver->GetNumberOfSolves(), 1);
    return;
  }
  const char* const properties[] = { "Power Fields", "Face Fields", "One Forms" };
  EXPECT_NE(messages.Error().find(std::string("Directional Prolongation (vtkDirectionalProlongation) with ") +
              properties[GetParam()] + " on"),
    std::string::npos)
    << messages.Error();
  ExpectEmpty(solver);

  messages.Forget();
  prolongation->SetPowerFields(GetParam() == Solver::PowerField);
  prolongation->SetFaceFields(GetParam() == Solver::FaceField);
  prolongation->SetOneForms(GetParam() == Solver::OneForm);
  solver->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  EXPECT_EQ(solver->GetNumberOfSolves(), 1);
}

TEST_P(VectorField, OfDamagedOperatorsIsRefused)
{
  vtkNew<vtkPolyData> input;
  input->DeepCopy(SphereWithOperators());
  const std::string name = std::string("Prolongation.") + (GetParam() == Solver::OneForm ? "S1" : "SX") + ".1.Values";
  auto* const values = vtkDoubleArray::SafeDownCast(input->GetFieldData()->GetAbstractArray(name.c_str()));
  ASSERT_TRUE(values);
  const double good = values->GetValue(3);
  values->SetValue(3, std::numeric_limits<double>::infinity());
  const auto solver = NewSolver(input, GetParam());
  solver->SetSolver(Solver::ConjugateGradients);
  solver->SetCoarseSpace(Solver::StructurePreserving);
  Messages messages(solver);
  solver->Update();
  EXPECT_NE(messages.Error().find("'" + name + "' holds a value"), std::string::npos) << messages.Error();
  ExpectEmpty(solver);

  messages.Forget();
  values->SetValue(3, good);
  input->Modified();
  solver->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
}

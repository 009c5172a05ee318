// Prescriptions that a solver cannot follow.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"

#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

struct BadInput
{
  std::string Name;
  std::function<void(vtkPolyData*, vtkHarmonicFieldSolver*)> Spoil;
  std::vector<std::string> Words; ///< that the message must contain: element and remedy
};

std::ostream& operator<<(std::ostream& os, const BadInput& input)
{
  return os << input.Name;
}

class RefusedConstraints : public testing::TestWithParam<BadInput>
{
};

void Choose(vtkHarmonicFieldSolver* solver, int index, int association, const char* name)
{
  solver->SetInputArrayToProcess(index, 0, 0, association, name);
}

const BadInput BadInputs[] = {
  { "AllVectorsZero",
    [](vtkPolyData* input, vtkHarmonicFieldSolver*) { input->GetCellData()->GetArray("Given")->Fill(0.0); },
    { "no direction is prescribed", "choose" } },
  { "ArrayThatDoesNotExist", [](vtkPolyData*, vtkHarmonicFieldSolver* solver) { Choose(solver, 1, OnCells, "Gone"); },
    { "'Gone'", "directions of the surface", "choose" } },
  { "ArrayOfPointsChosenOnCells",
    [](vtkPolyData*, vtkHarmonicFieldSolver* solver) { Choose(solver, 1, OnPoints, "Given"); },
    { "'Given'", "choose" } },
  { "ScalarsAsVectors",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetCellData()->AddArray(Zeros("Scalars", 1280, 1));
      Choose(solver, 1, OnCells, "Scalars");
    },
    { "'Scalars'", "3 numbers", "choose" } },
  { "TextAsMask",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      vtkNew<vtkStringArray> text;
      text->SetName("Text");
      text->SetNumberOfValues(1280);
      input->GetCellData()->AddArray(text);
      Choose(solver, 0, OnCells, "Text");
    },
    { "'Text'", "mask of the surface", "choose" } },
  { "MaskElsewhereThanVectors",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetPointData()->AddArray(Zeros("Mask", input->GetNumberOfPoints(), 1));
      Choose(solver, 0, OnPoints, "Mask");
    },
    { "'Mask'", "'Given'", "choose" } },
  { "MaskWithoutVectors",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetCellData()->AddArray(Zeros("Mask", 1280, 1));
      Choose(solver, 0, OnCells, "Mask");
      Choose(solver, 1, OnCells, "");
    },
    { "'Mask'", "choose" } },
  { "MaskedZero",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      const auto mask = Zeros("Mask", 1280, 1);
      mask->SetValue(33, 1.0);
      input->GetCellData()->AddArray(mask);
      Choose(solver, 0, OnCells, "Mask");
    },
    { "no direction is prescribed", "zero", "choose" } },
  { "AllNotFinite",
    [](vtkPolyData* input, vtkHarmonicFieldSolver*)
    { input->GetCellData()->GetArray("Given")->Fill(std::numeric_limits<double>::quiet_NaN()); },
    { "no direction is prescribed", "not finite", "choose" } },
  { "WeightNotPositive",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      const auto weights = Zeros("Weights", 1280, 1);
      weights->SetValue(10, -1.0);
      input->GetCellData()->AddArray(weights);
      Choose(solver, 2, OnCells, "Weights");
    },
    { "cell 10", "weight", "positive" } },
  { "NormalAtAPoint",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      double normal[3]; // of an icosahedron's corner
      input->GetPoint(2, normal);
      AddPointVectors(input, "Normal", { { 2, Vector3(normal) } });
      Choose(solver, 1, OnPoints, "Normal");
    },
    { "no direction is prescribed", "perpendicular", "choose" } },
  { "AlignmentNotPositive", [](vtkPolyData*, vtkHarmonicFieldSolver* solver) { solver->SetAlignment(-1.0); },
    { "lignment" } },
  { "TensorsOfAnOddField",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      const auto tensors = Zeros("Stress", 1280, 6);
      tensors->Fill(1.0);
      input->GetCellData()->AddArray(tensors);
      Choose(solver, 1, OnCells, "Stress");
      solver->SetNumberOfDirections(3);
    },
    { "'Stress'", "no sign", "even Number Of Directions" } },
  { "VectorsOfThePlaneOnASphere",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetCellData()->AddArray(Zeros("Flat", 1280, 2));
      Choose(solver, 1, OnCells, "Flat");
    },
    { "'Flat'", "2 numbers", "Calculator" } },
  { "PointOutOfRange",
    [](vtkPolyData* input, vtkHarmonicFieldSolver*) {
      input->GetPolys()->InsertNextCell({ 0, 1, 2, 3333 });
    },
    { "cell 1280", "point 3333" } },
};

}

TEST_P(RefusedConstraints, NamesElementAndRemedyAndLeavesOutputsEmpty)
{
  const auto input = Sphere();
  const auto solver = NewSolver(input);
  solver->Update();
  GetParam().Spoil(input, solver);
  input->Modified();
  const Messages messages(solver);
  solver->Update();
  for (const std::string& word : GetParam().Words)
  {
    EXPECT_NE(messages.Error().find(word), std::string::npos) << "'" << word << "' is not in: " << messages.Error();
  }
  EXPECT_FALSE(messages.GetErrors().empty());
  ExpectEmpty(solver);
}

INSTANTIATE_TEST_SUITE_P(HarmonicFieldSolver, RefusedConstraints, testing::ValuesIn(BadInputs),
  [](const testing::TestParamInfo<BadInput>& info) { return info.param.Name; });

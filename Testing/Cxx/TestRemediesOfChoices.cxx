// What messages about arrays and options tell the user to do, done on the input that caused them: it works.

#include "RemedyScene.h"

#include "vtkDirectionalProlongation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

const Act ShortArray = [](Scene& scene) { scene.Array(OnCells, "Given")->SetNumberOfTuples(120); };
const Act WholeArray = [](Scene& scene)
{
  scene.Array(OnCells, "Given")->Resize(320);
  scene.Array(OnCells, "Given")->SetNumberOfTuples(320);
  scene.Array(OnCells, "Given")->FillComponent(0, 1.0);
  scene.Surface->Modified();
};
const Act AllZero = [](Scene& scene) { scene.Array(OnCells, "Given")->Fill(0.0); };

const Mistake OfArrays[] = {
  { "OtherComponents", Chosen(Directions, OnCells, "Weights"), "3 numbers per element; choose another",
    { Chosen(Directions, OnCells, "Given") } },
  { "FewTuples", ShortArray, "120 tuples for 320 cells; choose another, or have its source write one for each",
    { Chosen(Directions, OnPoints, "Given"), WholeArray } },
  { "NoSuchArray", Chosen(Directions, OnCells, "Wind"), "choose one of those, or none",
    { Chosen(Directions, OnCells, "Given"), NothingOnSurface } },
  { "MaskAlone", Both(NothingOnSurface, Masked), "choose an array of vectors as well",
    { Chosen(Directions, OnCells, "Given") } },
  { "MaskOfPoints", Chosen(Mask, OnPoints, "Mask"), "choose arrays of one kind",
    { Masked, Chosen(Directions, OnPoints, "Given") } },
  { "WeightNotPositive", Both(Weighted, Changed(OnCells, "Weights", -1.0)),
    "make it a positive number or make the direction zero",
    { Changed(OnCells, "Weights", 1.0), Changed(OnCells, "Given", None) } },
  { "AllZero", AllZero, "choose other arrays for Directions, Mask and Weights, or none for the smoothest field",
    { Chosen(Directions, OnCells, "Other"), NothingOnSurface } },
  { "AllMaskedOut",
    Both(Chosen(Directions, OnCells, "Other"),
      Both(Masked, [](Scene& scene) { scene.Array(OnCells, "Mask")->Fill(0.0); })),
    "choose other arrays for Directions, Mask and Weights, or none for the smoothest field",
    { Chosen(Mask, OnCells, ""), Both(Chosen(Mask, OnCells, ""), NothingOnSurface) } },
  { "AllWeightsZero", Both(Weighted, [](Scene& scene) { scene.Array(OnCells, "Weights")->Fill(0.0); }),
    "choose other arrays for Directions, Mask and Weights, or none for the smoothest field",
    { Chosen(Weights, OnCells, ""), Changed(OnCells, "Weights", 1.0),
      Both(Chosen(Weights, OnCells, ""), NothingOnSurface) } },
  { "ValuesOfCells", Both(IsFunction, Chosen(ValuesOfFunction, OnCells, "Values")), "choose arrays of points",
    { ValuesChosen } },
  { "NoValues", Both(IsFunction, NothingOnSurface), "choose an array of points for Values", { ValuesChosen } },
  { "NoValueInTheMask",
    Both(Both(Both(IsFunction, NothingOnSurface), ValuesChosen),
      Both(Chosen(Mask, OnPoints, "Mask"), [](Scene& scene) { scene.Array(OnPoints, "Mask")->Fill(0.0); })),
    "a Mask and Weights that are not zero everywhere", { Changed(OnPoints, "Mask", 1.0), Chosen(Mask, OnPoints, "") } },
  { "ValueNotFinite", Both(Both(IsFunction, ValuesChosen), Changed(OnPoints, "Values", HUGE_VAL)),
    "repair it, or leave the point out, by Mask or a value of NaN",
    { Changed(OnPoints, "Values", 1.0), Changed(OnPoints, "Values", NaN),
      Both(Both(NothingOnSurface, Chosen(Mask, OnPoints, "Mask")), Changed(OnPoints, "Mask", 0.0)) } },
  { "RotationNotFinite", Both(Chosen(Rotation, OnCells, "Values"), Changed(OnCells, "Values", NaN)),
    "repair it, or leave the direction out", { Changed(OnCells, "Values", 5.0), Changed(OnCells, "Given", None) } },
};

// Options
// ----------------------------------------------------------------------------------------------

const Act FollowsCurvature = Option(&vtkHarmonicFieldSolver::SetCurvatureWeight, 1.0);
const Act IsHard = Option(&vtkHarmonicFieldSolver::SetConstraintType, 1);
const auto SetBoundaryWeight = &vtkHarmonicFieldSolver::SetBoundaryWeight;

/// A sphere with slits, and what is prescribed lies in them.
const Act PrescribedOnSlivers = [](Scene& scene)
{
  scene.SetSurface(PolyDataOf(SphereWithZeroAreaFaces(2, 1)));
  scene.Solver->SetDiscretisation(vtkHarmonicFieldSolver::PowerField); // a corner has other triangles, too
  scene.Array(OnCells, "Given")->Fill(0.0);
  const vtkIdType last = scene.Surface->GetNumberOfCells() - 1;
  vtkNew<vtkIdList> corners;
  scene.Surface->GetCellPoints(last, corners);
  const Vector3 side =
    Vector3(scene.Surface->GetPoint(corners->GetId(1))) - Vector3(scene.Surface->GetPoint(corners->GetId(0)));
  scene.Array(OnCells, "Given")->SetTuple(last, side.data());
};

/// Operators of power fields alone, and a solver that uses them.
const Act WithOperators = [](Scene& scene)
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(scene.Surface);
  prolongation->SetMinimumNumberOfFaces(50);
  prolongation->Update();
  vtkNew<vtkPolyData> output;
  output->DeepCopy(prolongation->GetOutput());
  scene.SetSurface(output);
  scene.Solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
};
const Act Damaged = [](Scene& scene)
{
  vtkFieldData* const operators = scene.Surface->GetFieldData();
  for (int k = 0; k < operators->GetNumberOfArrays(); ++k)
  {
    if (auto* const numbers = vtkDoubleArray::SafeDownCast(operators->GetAbstractArray(k)))
    {
      numbers->SetValue(0, NaN);
    }
  }
};
const Act NoOperators = [](Scene& scene)
{
  scene.Surface->GetFieldData()->Initialize();
  scene.Surface->Modified();
};
Act NewOperators(bool hasOneForms)
{
  return [=](Scene& scene)
  {
    vtkNew<vtkDirectionalProlongation> prolongation;
    prolongation->SetInputData(scene.Surface);
    prolongation->SetOneForms(hasOneForms);
    scene.Solver->SetInputConnection(prolongation->GetOutputPort());
  };
}
const Act OneFormsOnLevels = [](Scene& scene)
{
  scene.Solver->SetDiscretisation(vtkHarmonicFieldSolver::OneForm);
  scene.Solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  scene.Solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
};
const Act WithoutCell10 = [](Scene& scene)
{
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = 0; cell < scene.Surface->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> corners;
    scene.Surface->GetPolys()->GetCellAtId(cell, corners);
    if (cell != 10 && corners->IsId(20) < 0)
    {
      cells->InsertNextCell(corners);
    }
  }
  vtkNew<vtkPolyData> rest;
  rest->SetPoints(scene.Surface->GetPoints());
  rest->SetPolys(cells);
  scene.SetSurface(rest);
};
const Act NoSuchPoint = [](Scene& scene) { scene.Surface->GetPolys()->ReplaceCellAtId(10, { 0, 1, 999 }); };
Act Point20At(double x)
{
  return [=](Scene& scene)
  {
    scene.Surface->GetPoints()->SetPoint(20, x, 0.5, 0.5);
    scene.Surface->GetPoints()->Modified();
    scene.Surface->Modified();
  };
}

const Mistake OfOptions[] = {
  { "HardCurvature", Both(FollowsCurvature, IsHard), "set Constraint Type to Soft, or Curvature Weight to 0",
    { Option(&vtkHarmonicFieldSolver::SetConstraintType, 0),
      Option(&vtkHarmonicFieldSolver::SetCurvatureWeight, 0.0) } },
  { "NegativeFeatureWeight", Option(SetBoundaryWeight, -1.0),
    "make it 0, for off, or from 1e-10 to 1e+10, and turn the field by Rotation",
    { Option(SetBoundaryWeight, 0.0),
      Both(Option(SetBoundaryWeight, 1.0), Option(&vtkHarmonicFieldSolver::SetRotation, 180.0)) } },
  { "Slivers", PrescribedOnSlivers, "prescribe a direction on another cell or make the constraints hard",
    { Changed(OnCells, "Given", Along), IsHard } },
  { "DamagedOperators", Both(WithOperators, Damaged),
    "remove the damaged operators or apply Directional Prolongation (vtkDirectionalProlongation) again",
    { NoOperators, NewOperators(false) } },
  { "MissingOperators", Both(WithOperators, OneFormsOnLevels),
    "apply Directional Prolongation (vtkDirectionalProlongation) with One Forms on", { NewOperators(true) } },
  { "NoSuchPoint", NoSuchPoint, "repair the source of the surface", { WithoutCell10 } },
  { "PointNotFinite", Point20At(NaN), "repair it or remove the cells around it", { Point20At(0.7), WithoutCell10 } },
  { "PointFarAway", Point20At(1e60), "repair it", { Point20At(0.7), WithoutCell10 } },
};

}

class RemedyOfChoice : public testing::TestWithParam<Mistake>
{
};

TEST_P(RemedyOfChoice, Helps)
{
  ExpectThatRemediesHelp(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Arrays, RemedyOfChoice, testing::ValuesIn(OfArrays), NameOf);
INSTANTIATE_TEST_SUITE_P(Options, RemedyOfChoice, testing::ValuesIn(OfOptions), NameOf);

// What messages about guides and singularities, and warnings, tell the user to do, done on the input that caused them: it
// works.

#include "RemedyScene.h"

#include "vtkArrayCalculator.h"
#include "vtkFillHolesFilter.h"
#include "vtkPolyDataNormals.h"
#include "vtkSmoothPolyDataFilter.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

// Guides
// ----------------------------------------------------------------------------------------------

const Act FarPoint = [](Scene& scene) { scene.Follow({ { 0, 0, 9 } }, Along); };
const Act NearPoint = [](Scene& scene) { scene.Follow({ { 0, 0, 1 } }, Along); };
const Act LineAlongNormal = [](Scene& scene) {
  scene.Follow({ scene.Centre(), scene.Centre() + 0.1 * scene.Normal() });
};
const Act LineAlongSide = [](Scene& scene) { scene.Follow({ scene.Centre(), scene.Centre() + 0.1 * scene.Side() }); };
const Act LineWithoutLength = [](Scene& scene) { scene.Follow({ scene.Centre(), scene.Centre() }); };
const Act VectorOfZero = [](Scene& scene)
{ scene.Follow({ scene.Centre() }, Along)->GetPointData()->GetArray("Wind")->Fill(0.0); };
const Act WithoutAny = [](Scene& scene) { scene.Solver->SetInputData(1, PolyDataOf(PlaneGrid(1, 1))); };
const Act AddVectorsToGuide = [](Scene& scene)
{
  vtkNew<vtkArrayCalculator> calculator;
  calculator->SetInputData(scene.Guide());
  calculator->SetResultArrayName("Wind");
  calculator->SetFunction("iHat + 0.5 * jHat - 0.25 * kHat");
  scene.Solver->SetInputConnection(1, calculator->GetOutputPort());
};
const Act VectorsNotMarked = [](Scene& scene) { scene.Guide()->GetPointData()->SetActiveVectors(nullptr); };
// In the plane of the triangle, as parts along normals of guides and of cells are not alike.
const Act AgainstGiven = [](Scene& scene)
{
  const Vector3 given(1.0, 0.5, -0.25);
  scene.Follow({ scene.Centre() }, given.dot(scene.Normal()) * scene.Normal() - given);
};
const Act BrokenLine = [](Scene& scene)
{
  LineAlongSide(scene);
  scene.Guide()->GetLines()->InsertNextCell({ 0, 99 });
};
Act WeightOfGuide(int association, double weight)
{
  return [=](Scene& scene)
  {
    LineAlongSide(scene);
    const auto array = Zeros("Pull", 1, 1);
    array->Fill(weight);
    association == OnCells ? void(scene.Guide()->GetCellData()->AddArray(array))
                           : void(scene.Guide()->GetFieldData()->AddArray(array));
    scene.Solver->SetGuideArrayToProcess(Weights, 1, 0, association, "Pull");
  };
}
Act ChosenOfGuide(const char* name)
{
  return [=](Scene& scene) { scene.Solver->SetGuideArrayToProcess(Directions, 1, 0, OnPoints, name); };
}

const Mistake OfGuides[] = {
  { "TooFar", Both(NothingOnSurface, FarPoint),
    "move them nearer to the surface, raise Maximum Distance, or take them out of Guides",
    { NearPoint, Option(&vtkHarmonicFieldSolver::SetMaximumDistance, 10.0), NoGuides } },
  { "LinePerpendicular", Both(NothingOnSurface, LineAlongNormal),
    "turn them along the surface, or take them out of Guides", { LineAlongSide, NoGuides } },
  { "VectorPerpendicular",
    Both(NothingOnSurface, [](Scene& scene) { scene.Follow({ scene.Centre() }, scene.Normal()); }),
    "turn them along the surface, or take them out of Guides",
    { [](Scene& scene) { scene.Follow({ scene.Centre() }, scene.Side()); }, NoGuides } },
  { "VectorZero", Both(NothingOnSurface, VectorOfZero), "choose others, or clear Guides for the smoothest field",
    { [](Scene& scene) { scene.Follow({ scene.Centre() }, scene.Side()); }, NoGuides } },
  { "LineWithoutLength", Both(NothingOnSurface, LineWithoutLength),
    "choose others, or clear Guides for the smoothest field", { LineAlongSide, NoGuides } },
  { "NothingToFollow", WithoutAny,
    "add vectors to its points or cells, as Calculator (vtkArrayCalculator) does, or take it out of Guides",
    { AddVectorsToGuide, NoGuides } },
  { "NoActiveVectors", Both(Both(NearPoint, VectorsNotMarked), ChosenOfGuide("")),
    "choose 'Wind', for example, as Guide Directions", { ChosenOfGuide("Wind"), NoGuides } },
  { "PointNotFinite",
    [](Scene& scene) {
      scene.Follow({ { 0, 0, NaN }, { 0, 0, 1 } }, Along);
    },
    "move the point or remove it",
    { [](Scene& scene) {
       scene.Follow({ { 0, 0.1, 1 }, { 0, 0, 1 } }, Along);
     },
      NearPoint } },
  { "BrokenCell", BrokenLine, "repair the source of the guide", { LineAlongSide } },
  { "WholeWeight", WeightOfGuide(InFieldData, -1.0), "make it a positive number, or take the guide out of Guides",
    { WeightOfGuide(InFieldData, 1.0), NoGuides } },
  { "WeightOfLine", WeightOfGuide(OnCells, -2.0), "make it a positive number, or remove the line",
    { WeightOfGuide(OnCells, 2.0), NoGuides } },
  { "NoSuchArray", Both(NearPoint, ChosenOfGuide("Rain")), "choose one of those, or none",
    { ChosenOfGuide("Wind"), Both(LineAlongSide, ChosenOfGuide("")) } },
};

// Singularities
// ----------------------------------------------------------------------------------------------

Act Prescribed(int number, double index = 0.0, int components = 1)
{
  return [=](Scene& scene) { scene.Prescribe(number, index, components); };
}
Act IndexArray(const char* name)
{
  return [=](Scene& scene) { scene.Solver->SetSingularityIndexArray(name); };
}
vtkDataArray* Indices(Scene& scene)
{
  scene.Solver->GetInputDataObject(2, 0)->Modified();
  return vtkPolyData::SafeDownCast(scene.Solver->GetInputDataObject(2, 0))->GetPointData()->GetArray("Index");
}
Act SingularityAt(const Vector3& place)
{
  return [=](Scene& scene)
  {
    scene.Prescribe(1, 0.0);
    vtkPolyData::SafeDownCast(scene.Solver->GetInputDataObject(2, 0))->GetPoints()->SetPoint(0, place.data());
  };
}
const Act OnPlate = [](Scene& scene) { scene.SetSurface(PolyDataOf(PlaneGrid(10, 10))); };
const Act NoSingularities = [](Scene& scene) { scene.Solver->RemoveAllSingularities(); };
const Act IsFaceField = Option(&vtkHarmonicFieldSolver::SetDiscretisation, 1);

const Mistake OfSingularities[] = {
  { "OtherIndex", Prescribed(6, 1.0 / 3.0), "multiples of 1/4; choose one of these, or another Number Of Directions",
    { Prescribed(8, 0.25), Option(&vtkHarmonicFieldSolver::SetNumberOfDirections, 3) } },
  { "TooFew", Prescribed(7), "add singularities of 0.25 in all", { Prescribed(8) } },
  { "TooMany", Prescribed(10), "take away 0.5 in all", { Prescribed(8) } },
  { "NoSuchArray", Both(Prescribed(8, 0.25), IndexArray("Wind")),
    "choose one of those, or none for an index of 1 / N each", { IndexArray("Index"), IndexArray("") } },
  { "OtherComponents", Prescribed(8, 0.25, 2), "choose another array as Singularity Index", { Prescribed(8, 0.25) } },
  { "FewTuples", Both(Prescribed(8, 0.25), [](Scene& scene) { Indices(scene)->SetNumberOfTuples(5); }),
    "5 tuples for 8 points; have its source write one for each",
    { [](Scene& scene)
      {
        Indices(scene)->InsertTuple1(7, 0.25);
        Indices(scene)->Fill(0.25);
      } } },
  { "OfVectors", Both(Prescribed(8), IsFaceField),
    "choose Power Field at Points as Discretisation, or take the input Singularities away",
    { Option(&vtkHarmonicFieldSolver::SetDiscretisation, 4), NoSingularities } },
  { "FarAway", Both(OnPlate, SingularityAt({ 5, 5, 9 })), "move it nearer, or raise Maximum Distance",
    { SingularityAt({ 5, 5, 0 }), Option(&vtkHarmonicFieldSolver::SetMaximumDistance, 2.0) } },
  { "InACorner",
    [](Scene& scene)
    {
      scene.SetSurface(PolyDataOf(PlaneGrid(1, 160)));
      SingularityAt({ 0.5, 5.0, 0.0 })(scene);
    },
    "move it away from the boundary, or leave it out", { Both(OnPlate, SingularityAt({ 5, 5, 0 })), Prescribed(0) } },
  { "LargeDirection", Both(Prescribed(8), Changed(OnCells, "Given", 1e100)), "bring it to at most 1e+40",
    { Changed(OnCells, "Given", Along) } },
};

}

class RemedyOfGuide : public testing::TestWithParam<Mistake>
{
};

TEST_P(RemedyOfGuide, Helps)
{
  ExpectThatRemediesHelp(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Guides, RemedyOfGuide, testing::ValuesIn(OfGuides), NameOf);
INSTANTIATE_TEST_SUITE_P(Singularities, RemedyOfGuide, testing::ValuesIn(OfSingularities), NameOf);

// Warnings
// ----------------------------------------------------------------------------------------------

namespace
{

const Act OfGenusTwo = [](Scene& scene)
{
  scene.SetSurface(PolyDataOf(DoubleTorus(4)));
  scene.Array(OnCells, "Given")->Fill(0.0);
  scene.Set(OnCells, "Given", scene.Side());
  scene.Solver->SetDiscretisation(vtkHarmonicFieldSolver::FaceField);
};
/// The first sides of every tenth triangle.
const Act MoreDirections = [](Scene& scene)
{
  for (vtkIdType cell = 0; cell < scene.Surface->GetNumberOfCells(); cell += 10)
  {
    vtkNew<vtkIdList> corners;
    scene.Surface->GetCellPoints(cell, corners);
    const Vector3 side =
      Vector3(scene.Surface->GetPoint(corners->GetId(1))) - Vector3(scene.Surface->GetPoint(corners->GetId(0)));
    scene.Array(OnCells, "Given")->SetTuple(cell, side.data());
  }
  scene.Surface->Modified();
};

/// On the outer of two spheres, whose inner one is nearer to the middle of chords.
Act ArcOfPoints(int number)
{
  return [=](Scene& scene)
  {
    Surface inner = Icosphere(3);
    inner.V *= 0.95;
    inner.F.col(1).swap(inner.F.col(2));
    scene.SetSurface(PolyDataOf(Union(Icosphere(3), inner, Vector3::Zero())));
    std::vector<Vector3> positions;
    for (int i = 0; i < number; ++i)
    {
      const double angle = 0.9 * i / (number - 1);
      positions.emplace_back(std::cos(angle), std::sin(angle), 0.01);
    }
    scene.Follow(positions);
  };
}

/// A torus with a spike, which is to have no singularity.
const Act Spiked = [](Scene& scene)
{
  const auto torus = PolyDataOf(Torus(20, 16));
  const Vector3 tip = 3.0 * Vector3(torus->GetPoint(20));
  torus->GetPoints()->SetPoint(20, tip.data());
  scene.SetSurface(torus);
  scene.Prescribe(0, 0.0);
};
const Act Smoothed = [](Scene& scene)
{
  vtkNew<vtkSmoothPolyDataFilter> smooth;
  smooth->SetInputData(scene.Surface);
  smooth->SetNumberOfIterations(100);
  smooth->SetRelaxationFactor(0.3);
  smooth->Update();
  scene.SetSurface(smooth->GetOutput());
};

/// A plate with 1,369 square holes.
const Act Perforated = [](Scene& scene)
{
  constexpr int Squares = 146;
  const auto plate = PolyDataOf(PlaneGrid(Squares, Squares));
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = 0; cell < plate->GetNumberOfCells(); ++cell)
  {
    const vtkIdType square = cell / 2;
    if (square % Squares % 4 != 1 || square / Squares % 4 != 1)
    {
      vtkNew<vtkIdList> corners;
      plate->GetCellPoints(cell, corners);
      cells->InsertNextCell(corners);
    }
  }
  plate->SetPolys(cells);
  scene.SetSurface(plate);
};
const Act HolesFilled = [](Scene& scene)
{
  vtkNew<vtkFillHolesFilter> fill;
  fill->SetInputData(scene.Surface);
  fill->SetHoleSize(1.0);
  vtkNew<vtkPolyDataNormals> normals; // as the next message says
  normals->SetInputConnection(fill->GetOutputPort());
  normals->SplittingOn();
  normals->SetFeatureAngle(180.0);
  normals->NonManifoldTraversalOff();
  normals->Update();
  scene.SetSurface(normals->GetOutput());
};
const Act AskForBasis = [](Scene& scene)
{
  scene.Solver->SetDiscretisation(vtkHarmonicFieldSolver::FaceField);
  scene.Solver->HarmonicBasisOn();
};

/// A solve that needs more iterations; without prescriptions, that of the smoothest field.
Act OneIteration(bool hasPrescriptions)
{
  return [=](Scene& scene)
  {
    scene.SetSurface(PolyDataOf(Icosphere(4))); // smaller ones are factored
    if (!hasPrescriptions)
    {
      NothingOnSurface(scene);
    }
    scene.Solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
    scene.Solver->SetMaximumNumberOfIterations(1);
  };
}

const Act MoreIterations = Option(&vtkHarmonicFieldSolver::SetMaximumNumberOfIterations, 100);

const Mistake WithWarnings[] = {
  { "Cancelling", Both(Option(&vtkHarmonicFieldSolver::SetNumberOfDirections, 1), AgainstGiven),
    "take one of them out, or choose a Number Of Directions to which they are alike",
    { NoGuides, Option(&vtkHarmonicFieldSolver::SetNumberOfDirections, 2) } },
  { "LimitOfIterations", OneIteration(true), "raise Maximum Number Of Iterations", { MoreIterations } },
  { "LimitOfIterationsOfTheSmoothestField", OneIteration(false), "raise Maximum Number Of Iterations",
    { MoreIterations } },
  { "UndeterminedHarmonicFields", OfGenusTwo, "prescribe more directions, spread over the handles and holes",
    { MoreDirections } },
  { "FarSideOfAWall", ArcOfPoints(2), "give their lines more points, or take them out of Guides",
    { ArcOfPoints(20), NoGuides } },
  { "LargeIndex", Prescribed(1, 2.0),
    "prescribe several of smaller index instead, farther apart, choose fewer directions, or smooth the surface there",
    { Prescribed(8), Option(&vtkHarmonicFieldSolver::SetNumberOfDirections, 1) } },
  { "Spike", Spiked, "choose fewer directions, or smooth the surface there",
    { Option(&vtkHarmonicFieldSolver::SetNumberOfDirections, 1), Smoothed } },
  { "BasisOfManyHoles", Both(Perforated, AskForBasis),
    "close its holes and remove its small handles first, or switch Harmonic Basis off",
    { HolesFilled, Option(&vtkHarmonicFieldSolver::SetHarmonicBasis, false) } },
};

std::string WarningOf(vtkAlgorithm* filter)
{
  const Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Error(), "");
  return messages.GetWarnings().empty() ? "" : messages.GetWarnings().front();
}

}

class RemedyOfWarning : public testing::TestWithParam<Mistake>
{
};

TEST_P(RemedyOfWarning, Helps)
{
  for (std::size_t k = 0; k < GetParam().Remedies.size(); ++k)
  {
    SCOPED_TRACE(k);
    Scene scene;
    GetParam().Make(scene);
    const std::string warning = WarningOf(scene.Solver);
    EXPECT_NE(warning.find(GetParam().Words), std::string::npos) << warning;
    GetParam().Remedies[k](scene);
    EXPECT_EQ(WarningOf(scene.Solver), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Messages, RemedyOfWarning, testing::ValuesIn(WithWarnings), NameOf);

TEST(Remedy, FilledHolesLeaveFewEnoughLoopsForSingularities)
{
  Scene scene;
  Perforated(scene);
  scene.Prescribe(0, 0.0);
  ExpectRefusal(scene.Solver, { "close holes and remove small handles first" });
  HolesFilled(scene);
  ExpectOutput(scene.Solver);
}

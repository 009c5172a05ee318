// What messages about fields that are drawn tell the user to do, done on the input that caused them: it works.

#include "RemedyScene.h"

#include "vtkFieldAngles.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

using Angles = vtkFieldAngles;

struct DrawingMistake
{
  std::string Name;
  std::function<void(Angles*, vtkPolyData*)> Make;
  std::string Words;
  std::vector<std::function<void(Angles*, vtkPolyData*)>> Remedies;
  bool IsChoice = false; ///< of an array; the surface goes on to show
};

std::ostream& operator<<(std::ostream& os, const DrawingMistake& mistake)
{
  return os << mistake.Name;
}

std::function<void(Angles*, vtkPolyData*)> Drawn(int index, const char* name)
{
  return [=](Angles* angles, vtkPolyData*) { angles->SetInputArrayToProcess(index, 0, 0, OnCells, name); };
}

/// Of cell 10 in an array of cells that is added if it is not there.
std::function<void(Angles*, vtkPolyData*)> Cell10(const char* name, const Vector3& vector)
{
  return [=](Angles*, vtkPolyData* surface)
  {
    vtkDataArray* array = surface->GetCellData()->GetArray(name);
    array = array ? array : AddCellVectors(surface, name, { { 10, None }, { 20, { 1.0, 2.0, 3.0 } } });
    array->SetTuple(10, vector.data());
    array->Modified();
    surface->Modified();
  };
}

const DrawingMistake WithFields[] = {
  { "NoField", [](Angles*, vtkPolyData* surface) { surface->GetCellData()->RemoveArray("Direction0"); },
    "apply Harmonic Field Solver (vtkHarmonicFieldSolver) first, or choose an array of vectors",
    { Drawn(0, "Given"),
      [](Angles* angles, vtkPolyData* surface)
      {
        vtkNew<vtkHarmonicFieldSolver> solver;
        solver->SetInputData(surface);
        angles->SetInputConnection(solver->GetOutputPort());
      } },
    true },
  { "NoSuchArray", Drawn(0, "Wind"), "choose one of those, or none", { Drawn(0, "Given"), Drawn(0, "") }, true },
  { "NoVectors", Drawn(0, "Weights"), "choose an array of vectors", { Drawn(0, "Given") }, true },
  { "NoDirections",
    [](Angles* angles, vtkPolyData* surface)
    {
      surface->GetCellData()->AddArray(Zeros("Calm", 320, 3));
      Drawn(0, "Calm")(angles, surface);
    },
    "choose another", { Drawn(0, "Given") }, true },
  { "Askew", Cell10("Direction1", Along), "draw one array at a time, with 1 as Number Of Directions",
    { [](Angles* angles, vtkPolyData*) { angles->SetNumberOfDirections(1); } } },
  { "NoAxis", [](Angles* angles, vtkPolyData*) { angles->SetAxis(0.0, 0.0, 0.0); },
    "Axis is (0, 0, 0), which has no direction; give it another value, or choose Reference Vectors",
    { [](Angles* angles, vtkPolyData*) { angles->SetAxis(0.0, 0.0, -2.0); }, Drawn(1, "Given") } },
  { "ReferenceNotFinite",
    [](Angles* angles, vtkPolyData* surface)
    {
      Cell10("Given", Vector3::Constant(NaN))(angles, surface);
      Drawn(1, "Given")(angles, surface);
    },
    "repair it, or choose other vectors or Axis", { Cell10("Given", Along), Drawn(1, "Other"), Drawn(1, "") } },
};

}

class RemedyOfField : public testing::TestWithParam<DrawingMistake>
{
};

TEST_P(RemedyOfField, Helps)
{
  for (std::size_t k = 0; k < GetParam().Remedies.size(); ++k)
  {
    SCOPED_TRACE(k);
    const Scene scene;
    Cell10("Direction0", { 0.5, 1.0, 0.25 })(nullptr, scene.Surface);
    vtkNew<vtkFieldAngles> angles;
    angles->SetInputData(scene.Surface);
    GetParam().Make(angles, scene.Surface);
    if (GetParam().IsChoice)
    {
      const Messages messages(angles);
      angles->Update();
      EXPECT_NE(messages.Error().find(GetParam().Words), std::string::npos) << messages.Error();
      EXPECT_EQ(messages.GetErrors().size(), 1u);
      EXPECT_EQ(angles->GetOutput()->GetNumberOfCells(), scene.Surface->GetNumberOfCells());
    }
    else
    {
      ExpectRefusal(angles, { GetParam().Words });
    }
    GetParam().Remedies[k](angles, scene.Surface);
    ExpectOutput(angles);
  }
}

INSTANTIATE_TEST_SUITE_P(Messages, RemedyOfField, testing::ValuesIn(WithFields),
  [](const testing::TestParamInfo<DrawingMistake>& info) { return info.param.Name; });

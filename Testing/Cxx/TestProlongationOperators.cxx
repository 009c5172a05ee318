// Which operators Directional Prolongation makes, and by which construction.

#include "vtkDirectionalProlongation.h"

#include "SolverTools.h"
#include "SurfaceEdges.h"

#include "vtkIntArray.h"
#include "vtkPartitionedDataSetCollection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A real operator of field data times a vector.
std::vector<double> Product(vtkFieldData* data, const std::string& name, const std::vector<double>& x)
{
  const auto array = [data, &name](const char* part)
  { return data->GetAbstractArray(("Prolongation." + name + "." + part).c_str()); };
  auto* const offsets = vtkIntArray::SafeDownCast(array("Offsets"));
  auto* const columns = vtkIntArray::SafeDownCast(array("Columns"));
  auto* const values = vtkDoubleArray::SafeDownCast(array("Values"));
  std::vector<double> result(offsets->GetNumberOfValues() - 1, 0.0);
  for (std::size_t row = 0; row < result.size(); ++row)
  {
    for (int i = offsets->GetValue(row); i < offsets->GetValue(row + 1); ++i)
    {
      result[row] += values->GetValue(i) * x.at(columns->GetValue(i));
    }
  }
  return result;
}

/// Differences along the edges, in the documented order and orientation.
std::vector<double> Differences(vtkPolyData* surface, const std::vector<double>& function)
{
  std::vector<double> differences;
  for (const auto& edge : EdgesOf(surface))
  {
    differences.push_back(function.at(edge.first.second) - function.at(edge.first.first));
  }
  return differences;
}

class Construction : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(DirectionalProlongation, Construction,
  testing::Values(vtkDirectionalProlongation::TrackedPaths, vtkDirectionalProlongation::ExactOverlay),
  [](const testing::TestParamInfo<int>& info) { return std::string(info.param ? "ExactOverlay" : "TrackedPaths"); });

}

// Any program can read the arrays: gradients stay gradients on edges numbered as documented.
TEST_P(Construction, CarriesGradientsBetweenTheLevels)
{
  const auto prolongation = NewProlongation(PolyDataOf(IrregularSphere(2, 3)));
  prolongation->SetConstruction(GetParam());
  prolongation->OneFormsOn();
  prolongation->Update();
  vtkFieldData* const data = prolongation->GetOutput()->GetFieldData();
  auto* const levels = vtkPartitionedDataSetCollection::SafeDownCast(prolongation->GetOutputDataObject(1));
  ASSERT_GE(levels->GetNumberOfPartitionedDataSets(), 2u);
  EXPECT_EQ(Values(data, "Prolongation.Options").at(4), GetParam());
  for (unsigned int level = 0; level + 1 < levels->GetNumberOfPartitionedDataSets(); ++level)
  {
    auto* const fine = vtkPolyData::SafeDownCast(levels->GetPartition(level, 0));
    auto* const coarse = vtkPolyData::SafeDownCast(levels->GetPartition(level + 1, 0));
    std::vector<double> function(coarse->GetNumberOfPoints());
    for (std::size_t i = 0; i < function.size(); ++i)
    {
      function[i] = std::sin(3.0 * i * i);
    }
    const std::string suffix = "." + std::to_string(level);
    EXPECT_LT(Difference(Product(data, "S1" + suffix, Differences(coarse, function)),
                Differences(fine, Product(data, "S0" + suffix, function))),
      1e-11);
  }
}

TEST_P(Construction, ServesEveryDiscretisation)
{
  const auto prolongation = NewProlongation(Sphere(2));
  prolongation->SetConstruction(GetParam());
  prolongation->FaceFieldsOn();
  prolongation->OneFormsOn();
  for (int discretisation : { Solver::PowerField, Solver::FaceField, Solver::OneForm })
  {
    const auto solver = NewSolver(nullptr, discretisation);
    solver->SetInputConnection(prolongation->GetOutputPort());
    solver->SetTolerance(1e-12);
    solver->SetSolver(Solver::Cholesky);
    solver->Update();
    const std::vector<double> exact = Unknowns(solver);
    solver->SetSolver(Solver::ConjugateGradients);
    solver->SetCoarseSpace(Solver::StructurePreserving); // linear levels would be samples
    solver->Update();
    EXPECT_GE(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 2u);
    EXPECT_LT(Difference(Unknowns(solver), exact), 1e-7);
  }
  EXPECT_EQ(prolongation->GetNumberOfSetups(), 1);
}

TEST(DirectionalProlongation, EverySelectionCounts)
{
  const auto prolongation = NewProlongation(Sphere(2));
  prolongation->Update();
  const auto names = [&prolongation]
  {
    std::set<std::string> found;
    vtkFieldData* const data = prolongation->GetOutput()->GetFieldData();
    for (const char* name : { "S0", "S1", "SX", "SP", "Nodal" })
    {
      if (data->HasArray(("Prolongation." + std::string(name) + ".0.Values").c_str()))
      {
        found.insert(name);
      }
    }
    return found;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(names(), (Names{ "S0", "SP", "Nodal" }));
  int setups = 1;
  const std::pair<std::function<void(vtkDirectionalProlongation*)>, Names> changes[] = {
    { [](auto* p) { p->OneFormsOn(); }, { "S0", "S1", "SP", "Nodal" } },
    { [](auto* p) { p->FaceFieldsOn(); }, { "S0", "S1", "SX", "SP", "Nodal" } },
    { [](auto* p) { p->PowerFieldsOff(); }, { "S0", "S1", "SX", "Nodal" } },
    { [](auto* p) { p->SetConstruction(1); }, { "S0", "S1", "SX", "Nodal" } },
  };
  for (const auto& [change, expected] : changes)
  {
    change(prolongation);
    prolongation->Update();
    EXPECT_EQ(names(), expected);
    EXPECT_EQ(prolongation->GetNumberOfSetups(), ++setups);
  }
}

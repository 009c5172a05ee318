#include "PropertiesOfSolver.h"

#include "vtkHarmonicFieldSolver.h"

#include <limits>
#include <string>
#include <vector>

namespace dmg
{

namespace
{

using F = vtkHarmonicFieldSolver;

constexpr double Any = std::numeric_limits<double>::infinity();

/// Adds properties that are members of the core's options.
struct Adder
{
  F* Filter;
  PropertyTable& Table;

  template <class Getter, class Value, class Member>
  void Number(const std::string& name, Getter get, void (F::*set)(Value), double least, double most, Member& member)
  {
    const Value value = (this->Filter->*get)();
    const bool isAny = least == -Any && most == Any; // weights are checked where they are used
    PropertyTable::Row& row = isAny ? this->Table.Number(name, value) : this->Table.Number(name, value, least, most);
    row.Is(member, value, this->SetterOf(set));
  }

  template <class Getter, class Member>
  void Choice(
    const std::string& name, Getter get, void (F::*set)(int), const std::vector<std::string>& names, Member& member)
  {
    const int value = (this->Filter->*get)();
    this->Table.Choice(name, value, names).Is(member, value, this->SetterOf(set));
  }

  template <class Getter, class Member>
  void Switch(const std::string& name, Getter get, void (F::*set)(bool), Member& member)
  {
    const bool value = (this->Filter->*get)();
    this->Table.Switch(name, value).Is(member, value, this->SetterOf(set));
  }

private:
  template <class Value>
  auto SetterOf(void (F::*set)(Value)) const
  {
    return [filter = this->Filter, set](Value value) { (filter->*set)(value); };
  }
};

/// Adds the properties that are no members of the core's options, or not as they are.
void AddOthers(F* filter, PropertyTable& table)
{
  table.Number("Rotation", filter->GetRotation(), -180, 180);
  table.Switch("TensorWeights", filter->GetTensorWeights());
  table.Vector("Axis", filter->GetAxis());
  table.Switch("FollowDirections", filter->GetFollowDirections());
  table.Text("GuideDirections", filter->GetGuideDirections());
  table.Text("GuideWeights", filter->GetGuideWeights());
  table.Text("SingularityIndexArray", filter->GetSingularityIndexArray());
  table.Switch("AllDirections", filter->GetAllDirections());
}

}

PropertyTable PropertyTableOf(F* filter, FieldProblem& problem)
{
  PropertyTable table;
  Adder add{ filter, table };
  // what the field is
  add.Choice("Discretisation", &F::GetDiscretisation, &F::SetDiscretisation,
    { "PowerField", "FaceField", "OneForm", "ScalarFunction", "PointPowerField" }, problem.Options.Field.Kind);
  add.Number("NumberOfDirections", &F::GetNumberOfDirections, &F::SetNumberOfDirections, 1, 8, problem.Options.Field.N);
  add.Choice(
    "ConstraintType", &F::GetConstraintType, &F::SetConstraintType, { "Soft", "Hard" }, problem.Options.Constraints);
  add.Number("Alignment", &F::GetAlignment, &F::SetAlignment, -Any, Any, problem.Options.Alignment);
  add.Number("SmoothingLength", &F::GetSmoothingLength, &F::SetSmoothingLength, 0, 1, problem.SmoothingLength);
  add.Switch("UnitLength", &F::GetUnitLength, &F::SetUnitLength, problem.UnitLength);
  add.Switch("UnitLengthWhileSmoothing", &F::GetUnitLengthWhileSmoothing, &F::SetUnitLengthWhileSmoothing,
    problem.UnitLengthWhileSmoothing);
  add.Switch("Combing", &F::GetCombing, &F::SetCombing, problem.Combing);
  add.Switch("HarmonicBasis", &F::GetHarmonicBasis, &F::SetHarmonicBasis, problem.HarmonicBasis);

  // what it follows
  FeatureOptions& features = problem.Features;
  add.Number("MaximumDistance", &F::GetMaximumDistance, &F::SetMaximumDistance, 0, Any, problem.Guides.MaximumDistance);
  add.Number("BoundaryWeight", &F::GetBoundaryWeight, &F::SetBoundaryWeight, -Any, Any, features.BoundaryWeight);
  add.Number(
    "BoundaryRotation", &F::GetBoundaryRotation, &F::SetBoundaryRotation, -180, 180, features.BoundaryRotation);
  add.Number(
    "SharpEdgesWeight", &F::GetSharpEdgesWeight, &F::SetSharpEdgesWeight, -Any, Any, features.SharpEdgesWeight);
  add.Number(
    "SharpEdgesRotation", &F::GetSharpEdgesRotation, &F::SetSharpEdgesRotation, -180, 180, features.SharpEdgesRotation);
  add.Number("FeatureAngle", &F::GetFeatureAngle, &F::SetFeatureAngle, 0, 180, features.FeatureAngle);
  add.Number("CurvatureWeight", &F::GetCurvatureWeight, &F::SetCurvatureWeight, -Any, Any, features.CurvatureWeight);
  add.Number(
    "CurvatureRotation", &F::GetCurvatureRotation, &F::SetCurvatureRotation, -180, 180, features.CurvatureRotation);
  add.Choice("CurvatureDirection", &F::GetCurvatureDirection, &F::SetCurvatureDirection,
    { "MaximumCurvature", "MinimumCurvature" }, features.FollowsMinimum);
  add.Number("CurvatureScale", &F::GetCurvatureScale, &F::SetCurvatureScale, 0, 100, features.CurvatureScale);
  add.Choice("NetSource", &F::GetNetSource, &F::SetNetSource, { "Refuse", "TakeOut" }, problem.Constraints.Net);

  // how it is found
  SolverOptions& solver = problem.Options.Solver;
  add.Choice("Solver", &F::GetSolver, &F::SetSolver,
    { "Automatic", "Cholesky", "VCycles", "ConjugateGradients", "NestedIterations", "CoarseProlongation" },
    solver.Kind);
  add.Number("ExpectedSolves", &F::GetExpectedSolves, &F::SetExpectedSolves, 1, Any, solver.ExpectedSolves);
  add.Choice("CoarseSpace", &F::GetCoarseSpace, &F::SetCoarseSpace, { "LinearInterpolation", "StructurePreserving" },
    problem.Options.CoarseSpace);
  add.Number("Tolerance", &F::GetTolerance, &F::SetTolerance, 1e-14, 1, problem.Stop.RelativeTolerance);
  add.Number("MaximumNumberOfIterations", &F::GetMaximumNumberOfIterations, &F::SetMaximumNumberOfIterations, 1, Any,
    problem.Stop.MaximumIterations);
  AddOthers(filter, table);
  return table;
}

FieldProperties PropertiesOf(vtkHarmonicFieldSolver* filter, const ConstraintArrays& guideChoices)
{
  FieldProblem problem;
  const PropertyTable table = PropertyTableOf(filter, problem);
  table.Check();
  table.ToCore();
  problem.Options.Alignment = problem.SmoothingLength == 0.0 ? problem.Options.Alignment : 1.0;
  problem.Rotation.Everywhere = problem.Options.Field.HasDirections() ? filter->GetRotation() * (Pi / 180.0) : 0.0;
  FieldProperties properties{ problem, { Numbering::Spatial, filter->GetJoinPoints(), filter->GetStrict() },
    ChoicesOf(filter), filter->GetFollowDirections(), guideChoices, filter->GetSingularityIndexArray(),
    filter->GetAllDirections() };
  properties.Choices.Axis = Vector3(filter->GetAxis());
  properties.Problem.Features.WarnsOfMissing = filter->GetWarnsOfMissingFeatures();
  properties.Choices.WeighsTensors = filter->GetTensorWeights();
  return properties;
}

}

// Sizes, lengths and weights at the ends of what doubles hold.

#include "vtkHarmonicFieldSolver.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Support/Errors.h"
#include "TestTools.h"

#include "vtkCleanPolyData.h"
#include "vtkDirectionalProlongation.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldSingularities.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// A torus of 1200 faces, with directions on three cells and values at three points.
vtkSmartPointer<vtkPolyData> Given(int exponentOfSize, int exponentOfDirections)
{
  Surface shape = Torus(30, 20);
  shape.V *= std::ldexp(1.0, exponentOfSize);
  auto input = PolyDataOf(shape);
  const double length = std::ldexp(1.0, exponentOfDirections);
  AddCellVectors(input, "Given",
    { { 7, { length, 2 * length, 3 * length } }, { 500, { -length, 0, length } }, { 1100, { 0, length, 0 } } });
  const auto values = Zeros("Values", input->GetNumberOfPoints(), 1);
  values->Fill(NaN);
  values->SetValue(3, length);
  values->SetValue(200, -length);
  values->SetValue(400, 0.0);
  input->GetPointData()->AddArray(values);
  return input;
}

vtkSmartPointer<vtkHarmonicFieldSolver> NewSolver(vtkPolyData* input, int discretisation)
{
  auto solver = vtkSmartPointer<vtkHarmonicFieldSolver>::New();
  solver->SetInputData(input);
  solver->SetDiscretisation(discretisation);
  solver->UnitLengthOff();
  const bool isFunction = discretisation == vtkHarmonicFieldSolver::ScalarFunction;
  solver->SetInputArrayToProcess(
    isFunction ? 3 : 1, 0, 0, isFunction ? OnPoints : OnCells, isFunction ? "Values" : "Given");
  return solver;
}

vtkSmartPointer<vtkPolyData> Scaled(vtkPolyData* input, double factor)
{
  vtkNew<vtkTransform> scale;
  scale->Scale(factor, factor, factor);
  vtkNew<vtkTransformPolyDataFilter> transform;
  transform->SetTransform(scale);
  transform->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  transform->SetInputData(input);
  transform->Update();
  return transform->GetOutput();
}

/// The message of a filter that is refused, with empty outputs; empty where it is not.
std::string Refusal(vtkAlgorithm* filter)
{
  const Messages messages(filter);
  filter->Update();
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    EXPECT_EQ(filter->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::CELL), 0);
    EXPECT_EQ(filter->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::ROW), 0);
  }
  return messages.Error();
}

void ExpectWords(const std::string& message, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
  }
}

}

// Sizes
// ----------------------------------------------------------------------------------------------

class Scale : public testing::TestWithParam<std::tuple<int, int>>
{
};

INSTANTIATE_TEST_SUITE_P(ExtremeNumbers, Scale,
  testing::Combine(testing::Range(0, 4),
    testing::Values(vtkHarmonicFieldSolver::Cholesky, vtkHarmonicFieldSolver::ConjugateGradients)));

// Powers of two change the exponents alone: fields scale with what is given, gradients also against the surface.
TEST_P(Scale, DoesNotChangeABit)
{
  const auto [discretisation, kind] = GetParam();
  const auto field = [discretisation = discretisation, kind = kind](int size, int length)
  {
    const auto solver = NewSolver(Given(size, length), discretisation);
    solver->SetSolver(kind);
    const Messages messages(solver);
    solver->Update();
    EXPECT_EQ(messages.Error(), "");
    return Values(solver->GetOutput()->GetCellData(), "Direction0");
  };
  const std::vector<double> expected = field(0, 0);
  for (const auto& [size, length] : { std::pair(-130, 0), std::pair(130, 0), std::pair(0, -130), std::pair(0, 130),
         std::pair(-130, 130), std::pair(130, -130) })
  {
    SCOPED_TRACE(testing::Message() << size << ' ' << length);
    std::vector<double> scaled = field(size, length);
    const int exponent = length - (discretisation == vtkHarmonicFieldSolver::ScalarFunction ? size : 0);
    for (double& number : scaled)
    {
      number = std::ldexp(number, -exponent);
    }
    EXPECT_EQ(scaled, expected);
  }
}

TEST(ExtremeNumbers, SurfacesAreRefusedAndTransformHelps)
{
  for (const auto& [exponent, words] : { std::pair(-332, std::vector<std::string>{ "smaller than 1e-40", "Transform" }),
         std::pair(664, std::vector<std::string>{ "point ", "beyond 1e40", "Transform" }) })
  {
    const auto input = Given(exponent, 0);
    for (int discretisation = 0; discretisation < 4; ++discretisation)
    {
      const auto solver = NewSolver(input, discretisation);
      ExpectWords(Refusal(solver), words);
      const auto scaled = Scaled(input, std::ldexp(1.0, -exponent));
      scaled->GetCellData()->ShallowCopy(input->GetCellData());
      solver->SetInputData(scaled);
      EXPECT_EQ(Refusal(NewSolver(input, discretisation)).empty(), false);
      const Messages messages(solver);
      solver->Update();
      EXPECT_EQ(messages.Error(), "");
      EXPECT_GT(solver->GetOutput()->GetNumberOfCells(), 0);
    }
    vtkNew<vtkDirectionalProlongation> prolongation;
    vtkNew<vtkFieldLines> lines;
    vtkNew<vtkFieldGlyphs> glyphs;
    vtkNew<vtkFieldSingularities> singularities;
    input->GetCellData()->SetActiveVectors("Given");
    for (vtkAlgorithm* const filter :
      std::initializer_list<vtkAlgorithm*>{ prolongation, lines, glyphs, singularities })
    {
      filter->SetInputDataObject(input);
      ExpectWords(Refusal(filter), words);
    }
  }
}

TEST(ExtremeNumbers, OnePointFarAwayIsRefusedByName)
{
  const auto input = Given(0, 0);
  input->GetPoints()->SetPoint(17, 0.0, -1e200, 0.0);
  ExpectWords(Refusal(NewSolver(input, vtkHarmonicFieldSolver::PowerField)), { "point 17", "repair" });
}

TEST(ExtremeNumbers, AFaceThatIsNearlyAPointIsRefusedAndCleanDropsIt)
{
  const auto input = Given(0, 0);
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(600, corners);
  for (int k = 0; k < 3; ++k)
  {
    input->GetPoints()->SetPoint(corners->GetId(k), k * 1e-150, 0.0, 0.0);
  }
  const auto solver = NewSolver(input, vtkHarmonicFieldSolver::PowerField);
  solver->StrictOn();
  ExpectWords(Refusal(solver), { "cell 600", "Clean (vtkCleanPolyData)", "Tolerance of 1e-12", "switch Strict off" });
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(input);
  clean->SetTolerance(1e-12);
  clean->ConvertPolysToLinesOff();
  solver->SetInputConnection(clean->GetOutputPort());
  const Messages messages(solver);
  solver->Update();
  EXPECT_EQ(messages.Error(), "");
  EXPECT_GT(solver->GetOutput()->GetNumberOfCells(), 0);
  solver->StrictOff();
  solver->SetInputData(input);
  solver->Update();
  EXPECT_EQ(messages.Error(), "");
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), input->GetNumberOfCells());
}

// What is prescribed
// ----------------------------------------------------------------------------------------------

TEST(ExtremeNumbers, DirectionsAndValuesAreRefusedWhereAllAreTooSmallOrOneIsTooLarge)
{
  for (int discretisation = 0; discretisation < 4; ++discretisation)
  {
    SCOPED_TRACE(discretisation);
    const bool isFunction = discretisation == vtkHarmonicFieldSolver::ScalarFunction;
    ExpectWords(Refusal(NewSolver(Given(0, -996), discretisation)),
      { isFunction ? "point 3" : "cell 7", "too small", "Calculator" });
    ExpectWords(Refusal(NewSolver(Given(0, 996), discretisation)),
      { isFunction ? "point 3" : "cell 7", "too large", "Calculator" });
    // One of a proper size is enough.
    const auto input = Given(0, 0);
    input->GetCellData()->GetArray("Given")->SetTuple3(500, 1e-300, 0.0, 1e-300);
    input->GetPointData()->GetArray("Values")->SetComponent(200, 0, 1e-300);
    const auto solver = NewSolver(input, discretisation);
    const Messages messages(solver);
    solver->Update();
    EXPECT_EQ(messages.Error(), "");
    EXPECT_NO_THROW(CheckArraysAreFinite(solver->GetOutput(), input));
  }
}

TEST(ExtremeNumbers, WeightsAreRefusedWhereAllAreTooSmallOrOneIsTooLarge)
{
  for (const auto& [weight, word] : { std::pair(1e-300, "too small"), std::pair(1e300, "too large") })
  {
    SCOPED_TRACE(weight);
    const auto input = Given(0, 0);
    const auto weights = Zeros("Weights", input->GetNumberOfCells(), 1);
    weights->Fill(weight);
    input->GetCellData()->AddArray(weights);
    const auto weighted = NewSolver(input, vtkHarmonicFieldSolver::PowerField);
    weighted->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
    ExpectWords(Refusal(weighted), { "weight", "cell 7", word });

    const auto aligned = NewSolver(input, vtkHarmonicFieldSolver::PowerField);
    aligned->SetAlignment(weight);
    ExpectWords(Refusal(aligned), { "Alignment", "from 1e-20 to 1e20" });
  }
}

// The exit
// ----------------------------------------------------------------------------------------------

namespace
{

/// Writes a number into an array of cells and into a point.
class WritesNumber : public vtkPolyDataAlgorithm
{
public:
  static WritesNumber* New();
  vtkTypeMacro(WritesNumber, vtkPolyDataAlgorithm);
  double InArray = 0.0;
  double InPoint = 0.0;

protected:
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    return MakeOutputs(this, request, inputs, outputs,
      [&](vtkInformationVector**, const ExecutionContext&)
      {
        vtkPolyData* const output = vtkPolyData::GetData(outputs);
        output->DeepCopy(vtkPolyData::GetData(inputs[0]));
        output->GetPoints()->SetPoint(2, 0.0, this->InPoint, 0.0);
        const auto array = Zeros("Mine", output->GetNumberOfCells(), 1);
        array->SetValue(5, this->InArray);
        output->GetCellData()->AddArray(array);
      });
  }
};

vtkStandardNewMacro(WritesNumber);

}

TEST(FilterRequests, NoNumberThatIsNotFiniteLeavesAFilter)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  vtkNew<WritesNumber> filter;
  filter->SetInputData(PolyDataOf(Icosphere(0)));
  for (const auto& [inArray, inPoint, word] : { std::tuple(NaN, 0.0, "'Mine'"), std::tuple(-Infinity, 0.0, "'Mine'"),
         std::tuple(0.0, Infinity, "a point"), std::tuple(0.0, NaN, "a point") })
  {
    filter->InArray = inArray;
    filter->InPoint = inPoint;
    filter->Modified();
    ExpectWords(Refusal(filter), { word, "finite" });
  }
  filter->InArray = filter->InPoint = 1e300;
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 20);
}

// Arrays of the input pass as they are, whatever they hold.
TEST(FilterRequests, ArraysOfTheInputMayHoldAnything)
{
  const auto input = Given(0, 0);
  const auto other = Zeros("Other", input->GetNumberOfCells(), 1);
  other->Fill(NaN);
  input->GetCellData()->AddArray(other);
  const auto solver = NewSolver(input, vtkHarmonicFieldSolver::PowerField);
  solver->Update();
  EXPECT_EQ(solver->GetOutput()->GetCellData()->GetArray("Other"), other);
}

// An abort that comes after the end is about nothing.
TEST(FilterRequests, AbortDuringTheLastProgressDoesNotEmptyTheNextUpdate)
{
  const auto input = Given(0, 0);
  const auto solver = NewSolver(input, vtkHarmonicFieldSolver::PowerField);
  solver->Update();
  const std::vector<double> expected = Values(solver->GetOutput()->GetCellData(), "Direction0");
  vtkNew<vtkCallbackCommand> abort; // at the end, when RequestData has returned
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*) { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  const unsigned long observer = solver->AddObserver(vtkCommand::EndEvent, abort);
  solver->Modified();
  solver->Update();
  solver->RemoveObserver(observer);
  EXPECT_EQ(Values(solver->GetOutput()->GetCellData(), "Direction0"), expected);
  solver->Modified();
  solver->Update();
  EXPECT_EQ(Values(solver->GetOutput()->GetCellData(), "Direction0"), expected);

  {
    const AbortAt last(solver, 1.0);
    solver->Modified();
    solver->Update();
    ASSERT_TRUE(last.Asked());
  }
  solver->Modified();
  solver->Update();
  EXPECT_EQ(Values(solver->GetOutput()->GetCellData(), "Direction0"), expected);
}

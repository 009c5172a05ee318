#ifndef dmgRemedyScene_h
#define dmgRemedyScene_h

#include "Refusals.h"
#include "TestTools.h"

#include "vtkHarmonicFieldSolver.h"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

/// A scene on which users make mistakes and do what the messages tell them.
namespace dmg::test
{

inline constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
inline constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
inline constexpr int InFieldData = vtkDataObject::FIELD_ASSOCIATION_NONE;
enum Input
{
  Mask,
  Directions,
  Weights,
  ValuesOfFunction,
  Rotation
};

/// A solver and its surface, a sphere of 320 triangles, which has these arrays on cells and on points: two directions, Given,
/// at the elements 10 and 100; a Mask that is 1 there; Weights of 1; Values of 2 there, else NaN; and Other, of vectors.
struct Scene
{
  Scene()
  {
    this->SetSurface(PolyDataOf(Icosphere(2)));
    this->Choose(Directions, OnCells, "Given");
  }

  void SetSurface(vtkPolyData* surface)
  {
    this->Surface = surface;
    for (const int association : { OnCells, OnPoints })
    {
      auto* const attributes = vtkDataSetAttributes::SafeDownCast(surface->GetAttributesAsFieldData(association));
      const vtkIdType size = surface->GetNumberOfElements(association);
      AddVectors(attributes, "Given", size, { { 10, { 1.0, 0.5, -0.25 } }, { 100, { -0.5, 0.25, 1.0 } } });
      AddVectors(attributes, "Other", size, { { 11, { 1.0, 0.5, -0.25 } } });
      for (const auto& [name, there, elsewhere] :
        { std::tuple("Mask", 1.0, 0.0), std::tuple("Weights", 1.0, 1.0), std::tuple("Values", 2.0, NaN) })
      {
        const auto array = Zeros(name, size, 1);
        array->Fill(elsewhere);
        array->SetValue(10, there);
        array->SetValue(100, there);
        attributes->AddArray(array);
      }
    }
    this->Solver->SetInputData(surface);
  }

  void Choose(Input array, int association, const char* name)
  {
    this->Solver->SetInputArrayToProcess(array, 0, 0, association, name);
  }

  vtkDataArray* Array(int association, const char* name)
  {
    return vtkDataArray::SafeDownCast(this->Surface->GetAttributesAsFieldData(association)->GetAbstractArray(name));
  }

  /// Of element 10.
  void Set(int association, const char* name, const Vector3& vector)
  {
    this->Array(association, name)->SetTuple(10, vector.data());
    this->Array(association, name)->Modified();
    this->Surface->Modified();
  }
  void Set(int association, const char* name, double number)
  {
    this->Set(association, name, Vector3::Constant(number));
  }

  Vector3 Corner(int k)
  {
    vtkNew<vtkIdList> corners;
    this->Surface->GetCellPoints(10, corners);
    return Vector3(this->Surface->GetPoint(corners->GetId(k)));
  }
  Vector3 Centre() { return (this->Corner(0) + this->Corner(1) + this->Corner(2)) / 3.0; }
  Vector3 Side() { return this->Corner(1) - this->Corner(0); }
  Vector3 Normal() { return this->Side().cross(this->Corner(2) - this->Corner(0)).normalized(); }

  /// A guide: a polyline, or, without lines, points with a vector each.
  vtkSmartPointer<vtkPolyData> Follow(const std::vector<Vector3>& positions, const Vector3& vector = Vector3::Zero())
  {
    const bool isLine = vector.isZero();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(static_cast<int>(positions.size()));
    Vectors vectors;
    for (const Vector3& position : positions)
    {
      lines->InsertCellPoint(points->InsertNextPoint(position.data()));
      vectors.push_back({ points->GetNumberOfPoints() - 1, vector });
    }
    vtkNew<vtkPolyData> guide;
    guide->SetPoints(points);
    isLine ? guide->SetLines(lines) : void(AddPointVectors(guide, "Wind", vectors));
    this->Solver->SetInputData(1, guide);
    isLine ? void() : this->Solver->SetGuideArrayToProcess(Directions, 1, 0, OnPoints, "Wind");
    return guide.Get();
  }
  vtkPolyData* Guide() { return vtkPolyData::SafeDownCast(this->Solver->GetInputDataObject(1, 0)); }

  /// The first \p number points of the surface that are a third of it apart, with an array of indices unless \p index is 0.
  void Prescribe(int number, double index, int components = 1)
  {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < number; ++i)
    {
      points->InsertNextPoint(this->Surface->GetPoint((i * 17 + 1) % this->Surface->GetNumberOfPoints()));
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    const auto indices = Zeros("Index", number, components);
    indices->Fill(index);
    index != 0.0 ? void(data->GetPointData()->AddArray(indices)) : void();
    this->Solver->SetInputData(2, data);
  }

  vtkSmartPointer<vtkPolyData> Surface;
  const vtkNew<vtkHarmonicFieldSolver> Solver;
};

using Act = std::function<void(Scene&)>;

struct Mistake
{
  std::string Name;
  Act Make;
  std::string Words;         ///< of the message: what it tells to do
  std::vector<Act> Remedies; ///< each of which helps alone
};

inline std::ostream& operator<<(std::ostream& os, const Mistake& mistake)
{
  return os << mistake.Name;
}

inline Act Chosen(Input array, int association, const char* name)
{
  return [=](Scene& scene) { scene.Choose(array, association, name); };
}

template <class Value>
Act Changed(int association, const char* name, const Value& value)
{
  return [=](Scene& scene) { scene.Set(association, name, value); };
}

template <class Value>
Act Option(void (vtkHarmonicFieldSolver::*set)(Value), Value value)
{
  return [=](Scene& scene) { (scene.Solver->*set)(value); };
}

inline Act Both(const Act& first, const Act& second)
{
  return [=](Scene& scene)
  {
    first(scene);
    second(scene);
  };
}

const Vector3 Along(1.0, 0.5, -0.25), None(0.0, 0.0, 0.0);
const Act Masked = Chosen(Mask, OnCells, "Mask");
const Act Weighted = Chosen(Weights, OnCells, "Weights");
const Act NothingOnSurface = Chosen(Directions, OnCells, "");
const Act IsFunction = Option(&vtkHarmonicFieldSolver::SetDiscretisation, 3);
const Act ValuesChosen = Chosen(ValuesOfFunction, OnPoints, "Values");
const Act NoGuides = [](Scene& scene) { scene.Solver->RemoveAllGuides(); };

/// The error tells what helps, and each remedy does.
inline void ExpectThatRemediesHelp(const Mistake& mistake)
{
  for (std::size_t k = 0; k < mistake.Remedies.size(); ++k)
  {
    SCOPED_TRACE(k);
    Scene scene;
    mistake.Make(scene);
    ExpectRefusal(scene.Solver, { mistake.Words });
    mistake.Remedies[k](scene);
    ExpectOutput(scene.Solver);
  }
}

inline std::string NameOf(const testing::TestParamInfo<Mistake>& info)
{
  return info.param.Name;
}

}

#endif

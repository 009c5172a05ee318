#ifndef dmgTestTools_h
#define dmgTestTools_h

#include "Support/MeshFactory.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dmg::test
{

/// Hears the errors and warnings of a filter, which then do not go to the terminal.
class Messages
{
public:
  explicit Messages(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
  {
    this->Errors = Listen(algorithm, vtkCommand::ErrorEvent, &this->ErrorTexts);
    this->Warnings = Listen(algorithm, vtkCommand::WarningEvent, &this->WarningTexts);
    // It adds that the algorithm failed.
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  }
  ~Messages()
  {
    this->Algorithm->GetExecutive()->RemoveObserver(this->Errors);
    this->Algorithm->RemoveObserver(this->Errors);
    this->Algorithm->RemoveObserver(this->Warnings);
  }
  Messages(const Messages&) = delete;
  void operator=(const Messages&) = delete;

  const std::vector<std::string>& GetErrors() const { return this->ErrorTexts; }
  const std::vector<std::string>& GetWarnings() const { return this->WarningTexts; }
  /// The first error, which is the filter's own; empty if there was none.
  std::string Error() const { return this->ErrorTexts.empty() ? "" : this->ErrorTexts.front(); }
  bool Silent() const { return this->ErrorTexts.empty() && this->WarningTexts.empty(); }
  void Forget()
  {
    this->ErrorTexts.clear();
    this->WarningTexts.clear();
  }

private:
  static vtkSmartPointer<vtkCallbackCommand> Listen(
    vtkAlgorithm* algorithm, unsigned long event, std::vector<std::string>* texts)
  {
    auto command = vtkSmartPointer<vtkCallbackCommand>::New();
    command->SetClientData(texts);
    command->SetCallback([](vtkObject*, unsigned long, void* list, void* text)
      { static_cast<std::vector<std::string>*>(list)->emplace_back(static_cast<const char*>(text)); });
    algorithm->AddObserver(event, command);
    return command;
  }

  const vtkSmartPointer<vtkAlgorithm> Algorithm;
  std::vector<std::string> ErrorTexts, WarningTexts;
  vtkSmartPointer<vtkCallbackCommand> Errors, Warnings;
};

/// Asks a filter to abort the first time that its progress reaches a fraction, for as long as this
/// object lives.
class AbortAt
{
public:
  AbortAt(vtkAlgorithm* algorithm, double fraction)
    : Algorithm(algorithm)
    , Fraction(fraction)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*)
      {
        auto* const abort = static_cast<AbortAt*>(self);
        if (!abort->Done && abort->Algorithm->GetProgress() >= abort->Fraction)
        {
          abort->Done = true;
          abort->Algorithm->SetAbortExecute(1);
        }
      });
    algorithm->AddObserver(vtkCommand::ProgressEvent, this->Command);
  }
  ~AbortAt() { this->Algorithm->RemoveObserver(this->Command); }
  AbortAt(const AbortAt&) = delete;
  void operator=(const AbortAt&) = delete;

  bool Asked() const { return this->Done; }

private:
  vtkAlgorithm* const Algorithm;
  const double Fraction;
  bool Done = false;
  vtkNew<vtkCallbackCommand> Command;
};

inline vtkSmartPointer<vtkPolyData> PolyDataOf(const Surface& surface, int precision = VTK_DOUBLE)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (int i = 0; i < surface.V.rows(); ++i)
  {
    points->InsertNextPoint(surface.V(i, 0), surface.V(i, 1), surface.V(i, 2));
  }
  vtkNew<vtkCellArray> triangles;
  for (int f = 0; f < surface.F.rows(); ++f)
  {
    triangles->InsertNextCell({ surface.F(f, 0), surface.F(f, 1), surface.F(f, 2) });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

/// A named array of zeros, for cells or points.
inline vtkSmartPointer<vtkDoubleArray> Zeros(const std::string& name, vtkIdType tuples, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  return array;
}

/// Adds an array of vectors that are zero but for some elements; returns it.
using Vectors = std::vector<std::pair<vtkIdType, Vector3>>;
inline vtkDoubleArray* AddVectors(
  vtkDataSetAttributes* attributes, const std::string& name, vtkIdType size, const Vectors& vectors)
{
  const auto array = Zeros(name, size, 3);
  for (const auto& [id, vector] : vectors)
  {
    array->SetTuple(id, vector.data());
  }
  attributes->AddArray(array);
  return array;
}

inline vtkDoubleArray* AddCellVectors(vtkPolyData* data, const std::string& name, const Vectors& vectors)
{
  return AddVectors(data->GetCellData(), name, data->GetNumberOfCells(), vectors);
}

inline vtkDoubleArray* AddPointVectors(vtkDataSet* data, const std::string& name, const Vectors& vectors)
{
  return AddVectors(data->GetPointData(), name, data->GetNumberOfPoints(), vectors);
}

inline Vector3 Tuple(vtkDataSetAttributes* attributes, const std::string& name, vtkIdType id)
{
  Vector3 vector;
  attributes->GetArray(name.c_str())->GetTuple(id, vector.data());
  return vector;
}

inline std::vector<double> Values(vtkFieldData* data, const std::string& name)
{
  auto* const array = vtkDoubleArray::SafeDownCast(data->GetAbstractArray(name.c_str()));
  return array ? std::vector<double>(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
               : std::vector<double>();
}

}

#endif

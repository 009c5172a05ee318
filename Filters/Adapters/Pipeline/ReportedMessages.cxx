#include "Adapters/Pipeline/ReportedMessages.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <mutex>
#include <set>

namespace dmg
{

bool HasFailedBefore(vtkAlgorithm* algorithm, vtkInformationVector** inputs, const std::string& message)
{
  static vtkInformationStringKey* const lastFailure =
    vtkInformationStringKey::MakeKey("LAST_FAILURE", "DirectionalMultigrid");
  std::string failure = message + " " + std::to_string(algorithm->GetMTime());
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < inputs[port]->GetNumberOfInformationObjects(); ++k)
    {
      vtkDataObject* const data = vtkDataObject::GetData(inputs[port], k);
      failure += " " + std::to_string(data ? data->GetMTime() : 0);
    }
  }
  const char* const before = algorithm->GetInformation()->Get(lastFailure);
  if (before && failure == before)
  {
    return true;
  }
  algorithm->GetInformation()->Set(lastFailure, failure.c_str());
  return false;
}

void ReportOnce(
  vtkAlgorithm* algorithm, vtkInformationVector* outputs, const std::string& name, const std::string& note)
{
  vtkNew<vtkStringArray> text;
  text->SetName(name.c_str());
  text->InsertNextValue(note);
  vtkDataObject::GetData(outputs, 0)->GetFieldData()->AddArray(text);

  static std::mutex mutex;
  static std::set<std::string> told;
  const std::string line = std::string(algorithm->GetClassName()) + ": " + note;
  const std::lock_guard<std::mutex> lock(mutex);
  if (told.insert(line).second)
  {
    vtkLog(INFO, << line);
  }
}

}

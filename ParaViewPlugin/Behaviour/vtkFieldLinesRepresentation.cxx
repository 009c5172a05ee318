#include "vtkFieldLinesRepresentation.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerStream.h"
#include "vtkFieldLines.h"
#include "vtkObjectFactory.h"
#include "vtkView.h"

#include <string>

vtkStandardNewMacro(vtkFieldLinesRepresentation);

namespace
{
// What the wrapping of a module would do: the method of that name, else that of the superclass.
int Call(vtkClientServerInterpreter* interpreter, vtkObjectBase* object, const char* method,
  const vtkClientServerStream& message, vtkClientServerStream& result, void*)
{
  auto* const representation = vtkFieldLinesRepresentation::SafeDownCast(object);
  const std::string name = method;
  vtkGeometryRepresentation* lines = nullptr;
  double distance = 0.0;
  if (name == "SetLines" && vtkClientServerStreamGetArgumentObject(message, 0, 2, &lines, "vtkGeometryRepresentation"))
  {
    representation->SetLines(lines);
    return 1;
  }
  if (name == "SetLineDistance" && message.GetArgument(0, 2, &distance))
  {
    representation->SetLineDistance(distance);
    return 1;
  }
  return interpreter->CallCommandFunction("vtkGeometryRepresentationWithFaces", object, method, message, result);
}
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::Register(vtkClientServerInterpreter* interpreter)
{
  interpreter->AddNewInstanceFunction(
    "vtkFieldLinesRepresentation", [](void*) -> vtkObjectBase* { return vtkFieldLinesRepresentation::New(); });
  interpreter->AddCommandFunction("vtkFieldLinesRepresentation", Call);
}

//------------------------------------------------------------------------------
vtkFieldLinesRepresentation::vtkFieldLinesRepresentation() = default;

//------------------------------------------------------------------------------
vtkFieldLinesRepresentation::~vtkFieldLinesRepresentation() = default;

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetLines(vtkGeometryRepresentation* lines)
{
  this->Lines = lines;
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetLineDistance(double distance)
{
  if (this->Filter->GetSeparatingDistance() != distance)
  {
    this->Filter->SetSeparatingDistance(distance);
    this->Lines->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Superclass::SetInputConnection(port, input);
  this->Filter->SetInputConnection(input);
  this->Lines->SetInputConnection(input ? this->Filter->GetOutputPort() : nullptr);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetInputConnection(vtkAlgorithmOutput* input)
{
  this->SetInputConnection(0, input);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::AddInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Superclass::AddInputConnection(port, input);
  this->Filter->SetInputConnection(input);
  this->Lines->SetInputConnection(this->Filter->GetOutputPort());
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::AddInputConnection(vtkAlgorithmOutput* input)
{
  this->AddInputConnection(0, input);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::RemoveInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Superclass::RemoveInputConnection(port, input);
  this->Filter->RemoveAllInputs();
  this->Lines->SetInputConnection(nullptr);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::RemoveInputConnection(int port, int index)
{
  this->Superclass::RemoveInputConnection(port, index);
  this->Filter->RemoveAllInputs();
  this->Lines->SetInputConnection(nullptr);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::MarkModified()
{
  this->Superclass::MarkModified();
  this->Lines->MarkModified();
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetUpdateTime(double time)
{
  this->Superclass::SetUpdateTime(time);
  this->Lines->SetUpdateTime(time);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetForceUseCache(bool use)
{
  this->Superclass::SetForceUseCache(use);
  this->Lines->SetForceUseCache(use);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetForcedCacheKey(double key)
{
  this->Superclass::SetForcedCacheKey(key);
  this->Lines->SetForcedCacheKey(key);
}

//------------------------------------------------------------------------------
unsigned int vtkFieldLinesRepresentation::Initialize(unsigned int least, unsigned int largest)
{
  return this->Superclass::Initialize(this->Lines->Initialize(least, largest), largest);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetLogName(const std::string& name)
{
  this->Superclass::SetLogName(name);
  this->Lines->SetLogName(name + "/Lines");
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Lines->SetVisibility(visible);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetOpacity(double opacity)
{
  this->Superclass::SetOpacity(opacity);
  this->Lines->SetOpacity(opacity);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetOrientation(double x, double y, double z)
{
  this->Superclass::SetOrientation(x, y, z);
  this->Lines->SetOrientation(x, y, z);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetOrigin(double x, double y, double z)
{
  this->Superclass::SetOrigin(x, y, z);
  this->Lines->SetOrigin(x, y, z);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetPosition(double x, double y, double z)
{
  this->Superclass::SetPosition(x, y, z);
  this->Lines->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetScale(double x, double y, double z)
{
  this->Superclass::SetScale(x, y, z);
  this->Lines->SetScale(x, y, z);
}

//------------------------------------------------------------------------------
void vtkFieldLinesRepresentation::SetUserTransform(const double matrix[16])
{
  this->Superclass::SetUserTransform(matrix);
  this->Lines->SetUserTransform(matrix);
}

//------------------------------------------------------------------------------
bool vtkFieldLinesRepresentation::AddToView(vtkView* view)
{
  view->AddRepresentation(this->Lines);
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkFieldLinesRepresentation::RemoveFromView(vtkView* view)
{
  view->RemoveRepresentation(this->Lines);
  return this->Superclass::RemoveFromView(view);
}

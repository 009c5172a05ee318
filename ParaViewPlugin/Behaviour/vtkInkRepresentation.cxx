#include "vtkInkRepresentation.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerStream.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

vtkStandardNewMacro(vtkInkRepresentation);

//------------------------------------------------------------------------------
vtkInkRepresentation::vtkInkRepresentation() = default;

//------------------------------------------------------------------------------
vtkInkRepresentation::~vtkInkRepresentation() = default;

//------------------------------------------------------------------------------
void vtkInkRepresentation::Register(vtkClientServerInterpreter* interpreter)
{
  interpreter->AddNewInstanceFunction(
    "vtkInkRepresentation", [](void*) -> vtkObjectBase* { return vtkInkRepresentation::New(); });
  interpreter->AddCommandFunction("vtkInkRepresentation",
    [](vtkClientServerInterpreter* caller, vtkObjectBase* object, const char* method,
      const vtkClientServerStream& message, vtkClientServerStream& result, void*)
    { return caller->CallCommandFunction("vtkGeometryRepresentationWithFaces", object, method, message, result); });
}

//------------------------------------------------------------------------------
void vtkInkRepresentation::SetLineWidth(double width)
{
  this->LineWidth = width;
  this->Superclass::SetLineWidth(width);
}

//------------------------------------------------------------------------------
bool vtkInkRepresentation::AddToView(vtkView* view)
{
  if (auto* const shown = vtkPVRenderView::SafeDownCast(view))
  {
    this->Observer =
      shown->GetRenderer()->AddObserver(vtkCommand::StartEvent, this, &vtkInkRepresentation::BeforeRendering);
  }
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkInkRepresentation::RemoveFromView(vtkView* view)
{
  if (auto* const shown = vtkPVRenderView::SafeDownCast(view))
  {
    shown->GetRenderer()->RemoveObserver(this->Observer);
  }
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
// A screenshot of more pixels than the view has is made of tiles, each as large as the view.
void vtkInkRepresentation::BeforeRendering(vtkObject* renderer, unsigned long, void*)
{
  const int* const tiles = static_cast<vtkRenderer*>(renderer)->GetRenderWindow()->GetTileScale();
  this->Superclass::SetLineWidth(tiles[0] * this->LineWidth);
}

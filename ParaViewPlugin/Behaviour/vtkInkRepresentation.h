#ifndef vtkInkRepresentation_h
#define vtkInkRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"

class vtkClientServerInterpreter;

/// Lines whose width grows with a picture: a screenshot that is larger than the view shows them as wide, relative to everything else, as the
/// view does. VTK's lines are as many pixels wide there as in the view.
class vtkInkRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkInkRepresentation* New();
  vtkTypeMacro(vtkInkRepresentation, vtkGeometryRepresentationWithFaces);

  /// Lets ParaView's servers make this class by name: the plugin has no wrapping of its own.
  static void Register(vtkClientServerInterpreter* interpreter);

  /// The width in pixels of the view.
  void SetLineWidth(double width) override;

protected:
  vtkInkRepresentation();
  ~vtkInkRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkInkRepresentation(const vtkInkRepresentation&) = delete;
  void operator=(const vtkInkRepresentation&) = delete;

  void BeforeRendering(vtkObject* renderer, unsigned long event, void* data);

  double LineWidth = 1.0;
  unsigned long Observer = 0;
};

#endif

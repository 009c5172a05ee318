#ifndef vtkFieldLinesRepresentation_h
#define vtkFieldLinesRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

class vtkClientServerInterpreter;
class vtkFieldLines;

/// A surface with evenly spaced lines along the field on it, the array Direction0: two representations of which the second one has
/// vtkFieldLines before it. Lines are drawn only where somebody looks at them. What moves the surface, shows or hides it, moves, shows or
/// hides the lines; their colour and width are their own.
class vtkFieldLinesRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkFieldLinesRepresentation* New();
  vtkTypeMacro(vtkFieldLinesRepresentation, vtkGeometryRepresentationWithFaces);

  /// Lets ParaView's servers make this class and call its methods by name: the plugin has no wrapping of its own.
  static void Register(vtkClientServerInterpreter* interpreter);

  /// What shows the lines. To be set before this is added to a view.
  void SetLines(vtkGeometryRepresentation* lines);

  /// The distance between lines, as SeparatingDistance of vtkFieldLines.
  void SetLineDistance(double distance);

  void SetInputConnection(int port, vtkAlgorithmOutput* input) override;
  void SetInputConnection(vtkAlgorithmOutput* input) override;
  void AddInputConnection(int port, vtkAlgorithmOutput* input) override;
  void AddInputConnection(vtkAlgorithmOutput* input) override;
  void RemoveInputConnection(int port, vtkAlgorithmOutput* input) override;
  void RemoveInputConnection(int port, int index) override;

  void MarkModified() override;
  void SetUpdateTime(double time) override;
  void SetForceUseCache(bool use) override;
  void SetForcedCacheKey(double key) override;
  unsigned int Initialize(unsigned int least, unsigned int largest) override;
  void SetLogName(const std::string& name) override;

  void SetVisibility(bool visible) override;
  void SetOpacity(double opacity) override;
  void SetOrientation(double x, double y, double z) override;
  void SetOrigin(double x, double y, double z) override;
  void SetPosition(double x, double y, double z) override;
  void SetScale(double x, double y, double z) override;
  void SetUserTransform(const double matrix[16]) override;

protected:
  vtkFieldLinesRepresentation();
  ~vtkFieldLinesRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkFieldLinesRepresentation(const vtkFieldLinesRepresentation&) = delete;
  void operator=(const vtkFieldLinesRepresentation&) = delete;

  vtkNew<vtkFieldLines> Filter;
  vtkSmartPointer<vtkGeometryRepresentation> Lines;
};

#endif

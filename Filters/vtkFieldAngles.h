/**
 * @class   vtkFieldAngles
 * @brief   angles of a field of N directions on a surface against an axis or other vectors
 *
 * vtkFieldAngles measures fibre, helix and layer angles: on each triangle, the angle from a reference vector, projected to the plane
 * of the triangle, to the nearest direction of a field. Angles are counted counter-clockwise, seen
 * from the positive side of the surface (vtkOrientedSurfaceAlgorithm), and lie between -180 / N and 180 / N degrees. PositiveSide in the field data names the side. For lines and crosses the sign
 * of the reference does not matter.
 *
 * @section vtkFieldAngles-Inputs Inputs
 *
 * Port 0: a surface with a field, as vtkFieldDrawingAlgorithm describes it. The reference is Axis, or an array of vectors on cells
 * or points, chosen with SetInputArrayToProcess(1, 0, 0, association, name), of 3 components, or 2 in a plane of constant z. A triangle has
 * the mean of vectors at its corners.
 *
 * @section vtkFieldAngles-Output Output
 *
 * Port 0: of the type of the input, with all its arrays and
 *
 * | array | of    | components | type   | meaning                                                        |
 * | ----- | ----- | ---------- | ------ | -------------------------------------------------------------- |
 * | Angle | cells | 1          | double | in degrees; 0 where it is not defined; active scalars          |
 *
 * The angle is not defined where there is no direction, or where the reference is zero or perpendicular to the triangle;
 * a warning says on how many triangles.
 *
 * @section vtkFieldAngles-Execution Execution
 *
 * The time is linear in the triangles. Threads, errors, aborts and pieces are those of vtkOrientedSurfaceAlgorithm. Where the array
 * that is chosen is no field, the output is the input, beside the error, so that a window goes on to show the surface.
 *
 * @sa vtkHarmonicFieldSolver
 */

#ifndef vtkFieldAngles_h
#define vtkFieldAngles_h

#include "vtkDataSetAlgorithm.h"
#include "vtkFiltersDirectionalFieldsModule.h" // For export macro

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldAngles : public vtkDataSetAlgorithm
{
public:
  static vtkFieldAngles* New();
  vtkTypeMacro(vtkFieldAngles, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * N, the number of directions per point; see vtkFieldDrawingAlgorithm::SetNumberOfDirections. Default 0, range 0 to 8.
   */
  vtkSetMacro(NumberOfDirections, int);
  vtkGetMacro(NumberOfDirections, int);
  ///@}

  ///@{
  /**
   * The reference vector, of any length, where no array of reference vectors is chosen. Default (0, 0, 1). (0, 0, 0) is
   * an error.
   */
  vtkSetVector3Macro(Axis, double);
  vtkGetVector3Macro(Axis, double);
  ///@}

  /**
   * The period of the angles of the last update, 360 / N degrees; 0 before.
   */
  vtkGetMacro(Period, double);

  vtkFieldAngles(const vtkFieldAngles&) = delete;
  void operator=(const vtkFieldAngles&) = delete;

protected:
  vtkFieldAngles() = default;
  ~vtkFieldAngles() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  int NumberOfDirections = 0;
  double Period = 0.0;
  double Axis[3] = { 0.0, 0.0, 1.0 };
};

#endif

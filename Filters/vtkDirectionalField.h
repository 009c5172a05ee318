/**
 * @class   vtkDirectionalField
 * @brief   a smooth field on a surface, with lines along it and its singularities
 *
 * vtkDirectionalField is vtkHarmonicFieldSolver, vtkFieldLines and vtkFieldSingularities in one: what a person looks at
 * first. It takes the inputs, arrays and properties of vtkHarmonicFieldSolver, of which it is a kind, and shows every field
 * that this one computes: crosses and lines, vectors and flows with arrow heads, and gradients of functions. It follows the boundary and
 * sharp edges where there are any: BoundaryWeight and SharpEdgesWeight are 1 by default, and missing features are no warning.
 *
 * @section vtkDirectionalField-Inputs Inputs
 *
 * The inputs of vtkHarmonicFieldSolver: the surface on port 0, guides on ports 1, 3, 4 and 5, singularities on port 2.
 *
 * @section vtkDirectionalField-Outputs Outputs
 *
 * Port 0, the surface: output 0 of vtkHarmonicFieldSolver, whose edges and convergence are no outputs here.
 *
 * Port 1, the lines: vtkPolyData, the output of vtkFieldLines at LineDistance.
 *
 * Port 2, the singularities: vtkPolyData, the spheres of vtkFieldSingularities with SphereRadius.
 *
 * Port 3, the paths of guides: vtkPolyData, output 3 of vtkHarmonicFieldSolver.
 *
 * Nothing is drawn where the field is zero everywhere, with a warning.
 *
 * @section vtkDirectionalField-Execution Execution
 *
 * Stages are kept as in vtkHarmonicFieldSolver. Each update draws anew, in the time of vtkFieldLines and vtkFieldSingularities.
 *
 * @sa vtkHarmonicFieldSolver vtkFieldLines vtkFieldSingularities
 */

#ifndef vtkDirectionalField_h
#define vtkDirectionalField_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkHarmonicFieldSolver.h"

namespace dmg
{
class ExecutionContext;
class PropertyTable;
class RanksOfPipeline;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkDirectionalField : public vtkHarmonicFieldSolver
{
public:
  static vtkDirectionalField* New();
  vtkTypeMacro(vtkDirectionalField, vtkHarmonicFieldSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Distance between lines of one family, as a fraction of the surface's size (vtkFieldLines::SeparatingDistance).
   * Default 0.015, range 0.0005 to 1.
   */
  vtkSetMacro(LineDistance, double);
  vtkGetMacro(LineDistance, double);
  ///@}

  ///@{
  /**
   * Radius of the spheres, relative to the diagonal of the surface's bounding box (vtkFieldSingularities::SphereRadius).
   * Default 0.012, range 0 to 0.1.
   */
  vtkSetMacro(SphereRadius, double);
  vtkGetMacro(SphereRadius, double);
  ///@}

  bool GetWarnsOfMissingFeatures() const override { return false; }

  vtkDirectionalField(const vtkDirectionalField&) = delete;
  void operator=(const vtkDirectionalField&) = delete;

protected:
  vtkDirectionalField();
  ~vtkDirectionalField() override = default;

  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;
  /// The lines and singularities of the field that stands in the first output; without ranks, of one process.
  void Draw(
    vtkInformationVector* outputVector, const dmg::RanksOfPipeline* ranks, const dmg::ExecutionContext& context);

  double LineDistance = 0.015;
  double SphereRadius = 0.012;
};

#endif

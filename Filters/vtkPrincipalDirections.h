/**
 * @class   vtkPrincipalDirections
 * @brief   principal curvatures of a surface and their directions
 *
 * A surface bends most along one direction and least along another, perpendicular to it: the principal directions.
 * Remeshers and hatchings follow them by crosses, and fibres run along them on ridges.
 * vtkHarmonicFieldSolver follows them by itself (CurvatureWeight); this filter shows them, and lets them be chosen,
 * masked or weighted first.
 *
 * The filter computes the mean of the shape operator over a region around each point. Its eigenvalues and eigenvectors are the
 * curvatures and directions. A cell has the mean over the regions of its points. The region of a point is the connected part of
 * the surface within a ball of Scale mean edges, and at least the triangles around the point. On a
 * triangle the shape operator is the derivative of the points' normals, interpolated between its corners (S. Rusinkiewicz,
 * "Estimating curvatures and their derivatives on triangle meshes", 2004); its integral over a region is a corrected
 * curvature measure (J.-O. Lachaud, P. Romon and B. Thibert, "Corrected curvature measures", 2022), a successor of the
 * normal cycle (D. Cohen-Steiner and J.-M. Morvan, "Restricted Delaunay triangulations and normal cycle", 2003).
 * Noise inside a region cancels, so that the directions withstand the noise of scans.
 *
 * @section vtkPrincipalDirections-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it.
 *
 * @section vtkPrincipalDirections-Output Output
 *
 * Port 0: of the type of the input, with all its arrays, and, on cells and on points, as double
 *
 * | array            | components | meaning                                                                       |
 * | ---------------- | ---------- | ----------------------------------------------------------------------------- |
 * | MaximumDirection | 3          | unit vector along which the surface bends by MaximumCurvature                 |
 * | MinimumDirection | 3          | the same of MinimumCurvature, a quarter turn counter-clockwise from the other |
 * | MaximumCurvature | 1          | 1 / length, positive where the surface bends away from its positive side, as a sphere seen from outside |
 * | MinimumCurvature | 1          | at most MaximumCurvature                                                      |
 * | Confidence       | 1          | how clear the directions are, in [0, 1)                                       |
 *
 * The field data have PositiveSide, the side that counts as outside; see vtkHodgeDecomposition.
 *
 * Directions have no sign by nature. It is chosen so that they continue from cell to cell wherever possible, but for cuts between
 * the places where curvatures agree. Without a sign, streamlines and textures along them would end everywhere.
 *
 * A sphere of radius r has the curvatures 1 / r, its inside -1 / r; a saddle has one of either sign. Confidence is the
 * square of (MaximumCurvature - MinimumCurvature) / (|MaximumCurvature| + |MinimumCurvature| + 1 / D), D the diagonal of
 * the box around the surface: near to 1 on cylinders and saddles, near to 0 where both curvatures agree, as on spheres,
 * and where there is hardly any. Directions are zero where it is 0, and so are all arrays on elements that belong to no
 * triangle.
 *
 * A field follows them by vtkHarmonicFieldSolver with MaximumDirection as directions and Confidence as weights.
 * vtkFieldLines and the other filters that draw take these arrays for lines, NumberOfDirections 2, and draw both families
 * with 4. A copy under another name has to be given its number.
 *
 * @section vtkPrincipalDirections-Execution Execution
 *
 * The time is linear in the points and quadratic in Scale.
 *
 * @sa vtkHarmonicFieldSolver vtkFieldLines
 */

#ifndef vtkPrincipalDirections_h
#define vtkPrincipalDirections_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkPrincipalDirections : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkPrincipalDirections* New();
  vtkTypeMacro(vtkPrincipalDirections, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The radius of the region around a point, in units of the mean length of the edges. A larger one withstands more
   * noise and sees less detail. Default 3, range 0 (the neighbours of each point) to 100.
   */
  vtkSetMacro(Scale, double);
  vtkGetMacro(Scale, double);
  ///@}

  vtkPrincipalDirections(const vtkPrincipalDirections&) = delete;
  void operator=(const vtkPrincipalDirections&) = delete;

protected:
  vtkPrincipalDirections() = default;
  ~vtkPrincipalDirections() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;

  double Scale = 3.0;
};

#endif

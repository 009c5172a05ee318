/**
 * @class   vtkFieldSingularities
 * @brief   singularities, cuts and boundary indices of a field of N directions on a surface
 *
 * Around a singularity a field of N directions turns by a multiple of 1 / N of a turn: its index. vtkFieldSingularities
 * finds those at the vertices of the surface, the index of each loop of its boundary, and the cuts: the edges across
 * which the first direction does not go on as the first one.
 *
 * The directions on both sides of an edge are matched so that they turn least. The index of an inner vertex is its
 * angle defect plus the rotation of the field around it, over 2 pi. The index of a boundary loop is how many turns the
 * boundary's tangent makes against the field, with the surface on the left: 1 for a parallel field on a disc, 0 where
 * the field follows the boundary, -1 for a parallel field around a hole. With these, all indices sum to the Euler
 * characteristic on every surface (Poincare and Hopf).
 *
 * Of a power field at points (vtkHarmonicFieldSolver::PointPowerField) singularities stand on cells, and the same holds with
 * points and cells in each other's places: the index of a triangle is the rotation along its sides plus its curvature, over
 * 2 pi; a cut separates two points, and runs from the centre of one triangle beside their edge through its middle to the
 * centre of the other.
 *
 * All are outputs of one filter, since they are read from one matching of the field, and since their sum means
 * something only if they belong to the same field.
 *
 * @section vtkFieldSingularities-Inputs Inputs
 *
 * Cells without a direction (zero or NaN), as where data are masked, are holes of the surface: each has a loop of the boundary with its
 * index, and the Euler characteristic is that of the rest. One that is alone has the direction of a cell beside it, as in the middle of a
 * vortex.
 *
 * @section vtkFieldSingularities-Outputs Outputs
 *
 * Port 0, the singularities: vtkPolyData, a vertex per singular point, in the order of the points.
 *
 * | array               | of     | components | type   | meaning                                            |
 * | ------------------- | ------ | ---------- | ------ | -------------------------------------------------- |
 * | Index               | points | 1          | double | a multiple of 1 / N, never 0; the active scalars   |
 * | NumberOfDirections  | points | 1          | int    | N                                                  |
 * | PointId             | points | 1          | id     | number of the point in the input; of fields at points CellId, that of the cell |
 * | NumberOfAxes        | points | 1          | int    | n = N (1 - Index), without its sign                |
 * | Axis0, Axis1, ...   | points | 3          | double | unit vectors in which the field is radial, n of them, then zeros |
 * | SpiralAngle         | points | 1          | double | of index 1: degrees from the radius to the field, 0 an aster, 90 a vortex; else, and where no direction is near, 0 |
 * | SumOfIndices        | field  | 1          | double | of all points and all boundary loops               |
 * | EulerCharacteristic | field  | 1          | int    | of the surface, which is the same                  |
 *
 * So a defect of +1/2 of a nematic has one axis, from its head to its tail (along the divergence of Q), and one of -1/2 has three. They
 * are means over two rings of cells.
 *
 * Port 1, the cuts: vtkPolyData, a line per edge, from the smaller to the larger point index of the input. With combed
 * directions (vtkHarmonicFieldSolver::Combing) they are few, and N = 1 has none.
 *
 * | array   | of    | components | type   | meaning                                                    |
 * | ------- | ----- | ---------- | ------ | ---------------------------------------------------------- |
 * | Jump    | cells | 1          | int    | direction 0 on the left goes on as this one on the right |
 * | Rotation | cells | 1          | double | by how much directions turn from left to right, in radians |
 *
 * Port 2, the boundary: vtkPolyData, a closed polyline per loop, with the surface on its left.
 *
 * | array | of    | components | type   | meaning                                              |
 * | ----- | ----- | ---------- | ------ | ---------------------------------------------------- |
 * | Index | cells | 1          | double | a multiple of 1 / N, also 0; the active scalars      |
 *
 * Port 3, the spheres: vtkPolyData, a sphere of triangles around each singularity, to be looked at. Points have the arrays
 * of their singularity, but its axes, and SignColor, three unsigned char: red where Index is positive, green where it is negative. A mapper
 * shows them by SelectColorArray("SignColor").
 *
 * @section vtkFieldSingularities-Execution Execution
 *
 * The time is linear in the triangles. There is a warning where a singularity of larger
 * index looks like several of opposite signs, as the triangles around it are too few.
 *
 * @sa vtkFieldLines vtkFieldGlyphs vtkHarmonicFieldSolver
 */

#ifndef vtkFieldSingularities_h
#define vtkFieldSingularities_h

#include "vtkFieldDrawingAlgorithm.h"
#include "vtkFiltersDirectionalFieldsModule.h" // For export macro

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldSingularities : public vtkFieldDrawingAlgorithm
{
public:
  static vtkFieldSingularities* New();
  vtkTypeMacro(vtkFieldSingularities, vtkFieldDrawingAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Radius of the spheres, relative to the diagonal of the input's bounding box. Default 0.012, range 0 to 0.1.
   */
  vtkSetMacro(SphereRadius, double);
  vtkGetMacro(SphereRadius, double);
  ///@}

  vtkFieldSingularities(const vtkFieldSingularities&) = delete;
  void operator=(const vtkFieldSingularities&) = delete;

protected:
  vtkFieldSingularities();
  ~vtkFieldSingularities() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;

  double SphereRadius = 0.012;
};

#endif

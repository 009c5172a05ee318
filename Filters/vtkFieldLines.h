/**
 * @class   vtkFieldLines
 * @brief   evenly spaced lines along a field of N directions on a surface
 *
 * vtkFieldLines draws a field of N directions (N = 1: vectors, 2: lines, 4: crosses, 6: hexagonal) by streamlines on
 * the surface, along all of its directions and at an even distance from each other.
 *
 * A field of N directions has N / 2 families of lines through each point if N is even, two for crosses, and N if it is
 * odd. Lines of different families cross; those of one family keep a distance. It is measured along the surface:
 * the two sides of a thin plate do not see each other. Around a singularity one family turns into another.
 *
 * Lines are traced exactly: the field is constant on each triangle, where a line is straight, and beyond an edge it
 * goes on along the direction that turns least. There is no step length. A line ends at the boundary, in a
 * singularity, where the field is zero, or where it comes too near to another line of its family. One that comes back
 * to where it began is closed.
 *
 * See B. Jobard and W. Lefer, "Creating evenly-spaced streamlines of arbitrary density", 1997, and B. Spencer et al.,
 * "Evenly spaced streamlines for surfaces", 2009.
 *
 * @section vtkFieldLines-Output Output
 *
 * Port 0: vtkPolyData, a polyline per line. One that is closed ends with the point with which it began. Lines of vectors
 * (N = 1) have arrow heads, lines of three points with the arrays of their line (see ArrowHeads).
 *
 * | array     | of     | components | type   | meaning                                                    |
 * | --------- | ------ | ---------- | ------ | ---------------------------------------------------------- |
 * | Length    | cells  | 1          | double | of the line, in the unit of the points                     |
 * | Branch    | cells  | 1          | int    | family at the seed, 0 that of the array                    |
 * | Seed      | cells  | 1          | int    | number of the line, in the order in which they were drawn  |
 * | Magnitude | points | 1          | double | of the field; on an edge, the mean of both sides           |
 * | Normals   | points | 3          | float  | of the surface; the active normals, for ribbons            |
 *
 * Normals are unit vectors, and half as long at thin walls, of which lines show from their own side alone: where another sheet lies behind
 * within a hundredth of the surface's size (GetInkShader). Of two open sheets, normals point away from each other.
 *
 * @section vtkFieldLines-Execution Execution
 *
 * The time is linear in the triangles of the surface and in the length of all lines over their distance. One thread draws.
 *
 * @sa vtkFieldGlyphs vtkFieldSingularities vtkHarmonicFieldSolver
 */

#ifndef vtkFieldLines_h
#define vtkFieldLines_h

#include "vtkFieldDrawingAlgorithm.h"
#include "vtkFiltersDirectionalFieldsModule.h" // For export macro

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldLines : public vtkFieldDrawingAlgorithm
{
public:
  static vtkFieldLines* New();
  vtkTypeMacro(vtkFieldLines, vtkFieldDrawingAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Distance between lines of one family where they begin, as a fraction of the surface's size, the diagonal of the
   * box around its triangles. Default 0.015, range 0.0005 to 1. The number of lines and the time
   * grow with the inverse of its square.
   */
  vtkSetMacro(SeparatingDistance, double);
  vtkGetMacro(SeparatingDistance, double);
  ///@}

  ///@{
  /**
   * A line ends where it comes nearer to another one of its family than this times SeparatingDistance. Smaller values
   * give longer lines, which are less even. Default 0.5, range 0.05 to 0.9.
   */
  vtkSetMacro(SeparatingDistanceRatio, double);
  vtkGetMacro(SeparatingDistanceRatio, double);
  ///@}

  ///@{
  /**
   * Lines shorter than this times the distance between lines are left out; where these are all, a warning says what would do.
   * Default 4, range 0 to 1000.
   */
  vtkSetMacro(MinimumLength, double);
  vtkGetMacro(MinimumLength, double);
  ///@}

  ///@{
  /**
   * The distance of lines from the surface along its normal, as a fraction of the surface's size. Default 0, range 0 to 0.1: they
   * lie in the surface, and show from both sides of it where they are drawn nearer to the viewer, as ParaView does in the representation
   * Ink; for other programs, see GetInkShader(). Elsewhere a thousandth shows them from one side.
   */
  vtkSetMacro(Lift, double);
  vtkGetMacro(Lift, double);
  ///@}

  ///@{
  /**
   * Whether lines of vectors (N = 1) have arrow heads: one at the end of each line, and others on long lines, about 8
   * distances between lines apart. Other fields have none. Default on.
   */
  vtkSetMacro(ArrowHeads, bool);
  vtkGetMacro(ArrowHeads, bool);
  vtkBooleanMacro(ArrowHeads, bool);
  ///@}

  vtkFieldLines(const vtkFieldLines&) = delete;
  void operator=(const vtkFieldLines&) = delete;

protected:
  vtkFieldLines() = default;
  ~vtkFieldLines() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;

  double SeparatingDistance = 0.015;
  double SeparatingDistanceRatio = 0.5;
  double MinimumLength = 4.0;
  double Lift = 0.0;
  bool ArrowHeads = true;
};

#endif

/**
 * @class   vtkDirectionalProlongation
 * @brief   decimates a surface and keeps the operators that carry fields between the levels
 *
 * vtkDirectionalProlongation makes the thesis's levels of vtkHarmonicFieldSolver as a filter of its own, so
 * that the operators can be stored, reused by several solvers and looked at. The solver uses them for structure-preserving
 * coarse spaces, full multigrid (NestedIterations) and coarse prolongation only. Its default levels are samples of the
 * surface, which it makes itself, and faster.
 *
 * The surface is decimated by quadric-guided edge collapses, level after level. Each collapse
 * flattens the triangles around the edge, before and after, into one plane; the overlay of both
 * gives sparse operators that carry functions and directions from a level to the next finer one.
 * Level 0 is the surface itself.
 *
 * @section vtkDirectionalProlongation-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it.
 *
 * The operators refer to the triangles inside. Where these are not the cells and points of the surface,
 * Prolongation.CellsOfFaces and Prolongation.PointsOfVertices tell the cell of each triangle and the point of each vertex.
 *
 * @section vtkDirectionalProlongation-Outputs Outputs
 *
 * Port 0: of the type of the input, with all its arrays, and the operators as field data. Every VTK
 * writer stores them, and another process or machine solves with them without decimating again. The
 * arrays are hidden from array menus (vtkAbstractArray::GUI_HIDE); their names begin with
 * "Prolongation.":
 *
 * | field array            | type   | length         | meaning                                   |
 * | ---------------------- | ------ | -------------- | ----------------------------------------- |
 * | Format                 | int    | 1              | version of this list, now 2               |
 * | Digest                 | string | 1              | fingerprint of the points and triangles   |
 * | Options                | double | 8              | properties of this filter, in their order |
 * | NumbersOfVertices      | int    | levels         | finest first                              |
 * | NumbersOfEdges         | int    | levels         | finest first                              |
 * | NumbersOfFaces         | int    | levels         | finest first                              |
 * | S0.l.Offsets           | int    | rows + 1       | where each row starts                     |
 * | S0.l.Columns           | int    | non-zeros      | ascending in each row                     |
 * | S0.l.Values            | double | non-zeros      | functions, from level l + 1 to level l    |
 * | S1.l. ...              | double | as S0          | 1-forms, edges to edges (OneForms)        |
 * | SX.l. ...              | double | as S0          | face fields (FaceFields)                  |
 * | SP.l.Offsets, .Columns | int    | as above       | (PowerFields)                             |
 * | SP.l.Values            | double | 2 per non-zero | complex; directions, face to face         |
 * | Nodal.l. ...           |        | as SP          | vectors, vertex to vertex or (l = 0) face |
 *
 * A 1-form has a number per edge, its integral from the smaller to the larger point index; edges
 * are numbered in ascending order of (smaller, larger). A face field has two numbers per face, the
 * components in a frame whose first axis runs along the face's first side. With S0 and these,
 * gradients stay gradients and closed 1-forms stay closed: d0 S0 = S1 d0 and G S0 = SX G.
 *
 * SP and Nodal serve every number of directions. The modulus of a complex entry is its weight, the
 * argument the angle by which a direction turns on its way; on the powers of N directions it turns
 * N times as far.
 *
 * Port 1: vtkPartitionedDataSetCollection, the levels to look at, one vtkPolyData per level, the
 * finest first.
 *
 * @section vtkDirectionalProlongation-Execution Execution
 *
 * The work is repeated when the content of points or triangles, or a property, changes; an array
 * that is added to the input, or new objects with equal content, repeat nothing. The time is linear in the
 * number of triangles.
 *
 * @sa vtkHarmonicFieldSolver
 */

#ifndef vtkDirectionalProlongation_h
#define vtkDirectionalProlongation_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

#include <memory> // For std::unique_ptr

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkDirectionalProlongation : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkDirectionalProlongation* New();
  vtkTypeMacro(vtkDirectionalProlongation, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Faces of a level over faces of the next finer one. Default 0.25, range 0.05 to 0.9.
   */
  vtkSetMacro(FaceRatio, double);
  vtkGetMacro(FaceRatio, double);
  ///@}

  ///@{
  /**
   * The largest number of levels beside the surface itself. Default 3, range 0 to 20.
   */
  vtkSetMacro(MaximumNumberOfCoarseLevels, int);
  vtkGetMacro(MaximumNumberOfCoarseLevels, int);
  ///@}

  ///@{
  /**
   * No level is decimated below this many faces. Default 1000, at least 4.
   */
  vtkSetMacro(MinimumNumberOfFaces, int);
  vtkGetMacro(MinimumNumberOfFaces, int);
  ///@}

  enum CollapsePolicies
  {
    /** Rounds of collapses whose surroundings share no face, cheapest first; in parallel. */
    IndependentRounds = 0,
    /** One collapse after the other, always the cheapest, delaying the edges around it. */
    SequentialQueue = 1
  };

  ///@{
  /**
   * The order in which edges are collapsed, one of CollapsePolicies. Default IndependentRounds.
   */
  vtkSetMacro(CollapsePolicy, int);
  vtkGetMacro(CollapsePolicy, int);
  ///@}

  enum Constructions
  {
    /** Points and paths are carried through the collapses; fast, and few non-zeros per row. */
    TrackedPaths = 0,
    /**
     * The overlay of each collapse in exact arithmetic, and the product of all local operators, as
     * in the thesis; slow, and several times the non-zeros. The reference.
     */
    ExactOverlay = 1
  };

  ///@{
  /**
   * The way in which the operators are made, one of Constructions. Default TrackedPaths.
   */
  vtkSetMacro(Construction, int);
  vtkGetMacro(Construction, int);
  ///@}

  ///@{
  /**
   * The structure-preserving operators that are built beside S0 and Nodal, which serve every field: SP (PowerFields, of fields on
   * faces, default on), SX (FaceFields, default off), S1 (OneForms, default off).
   */
  vtkSetMacro(PowerFields, bool);
  vtkGetMacro(PowerFields, bool);
  vtkBooleanMacro(PowerFields, bool);
  vtkSetMacro(FaceFields, bool);
  vtkGetMacro(FaceFields, bool);
  vtkBooleanMacro(FaceFields, bool);
  vtkSetMacro(OneForms, bool);
  vtkGetMacro(OneForms, bool);
  vtkBooleanMacro(OneForms, bool);
  ///@}

  /**
   * The number of decimations that this object has done; it tells whether an update reused former operators.
   */
  int GetNumberOfSetups() const;

  vtkDirectionalProlongation(const vtkDirectionalProlongation&) = delete;
  void operator=(const vtkDirectionalProlongation&) = delete;

protected:
  vtkDirectionalProlongation();
  ~vtkDirectionalProlongation() override;

  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;

  // Defaults of these five are those of the core (dmg::HierarchyOptions).
  double FaceRatio;
  int MaximumNumberOfCoarseLevels;
  int MinimumNumberOfFaces;
  int CollapsePolicy;
  int Construction;
  bool PowerFields = true;
  bool FaceFields = false;
  bool OneForms = false;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

/**
 * @class   vtkOrientedSurfaceAlgorithm
 * @brief   base class of filters that take any surface as an oriented manifold
 *
 * Its subclasses compute on an oriented manifold of triangles, whose boundary may have any number of loops. The surface of the
 * user need not be one: it is prepared inside, and the output has its own cells and points.
 *
 * @section vtkOrientedSurfaceAlgorithm-Input Input
 *
 * Port 0: any vtkDataSet with cells of two dimensions, with or without boundary, in one or several parts; composite datasets leaf
 * by leaf. Polygons are cut into triangles inside, cells of higher order as VTK draws them. Cells of no or one dimension, hidden
 * cells and points without a cell take no part. A dataset with cells of three dimensions becomes its skin, as vtkGeometryFilter makes
 * it, which is the output: a vtkUnstructuredGrid where that is what came in, else a vtkPolyData. On several ranks, the volume is
 * gathered first. Points that coincide are joined (SetJoinPoints). Where the rest is no oriented manifold, triangles are turned, paired and
 * parted inside (SetStrict). The field data array SurfacePreparation counts it, as in "3 cells turned, 12 points joined":
 *
 * - components are oriented as most of their cells are; one with one side only is cut along a short seam;
 * - at an edge of more than two sheets, the two that continue each other most smoothly stay joined, and the others end there, but
 *   for two that meet within 45 degrees of a plane;
 * - a point at which several fans of cells meet counts as one for each of them;
 * - cells that are there twice, and duplicate ghosts, have the field of their twin;
 * - cells that are only a line or a point have the mean of the field around.
 *
 * Rotations, the order of directions, normal parts, curvatures, vorticity and angles are seen from the positive side, which is one of the shape,
 * whatever the order of rows and cells: the outside of a closed surface (of the solid, in its cavities) and of a part of a globe around the
 * origin, +z in a plane of constant z, the convex side of tubes and domes, else the side of most cells. The field data array PositiveSide
 * names it. Pieces on ranks that are solved in pieces have the side of their cells.
 *
 * @section vtkOrientedSurfaceAlgorithm-Execution Execution
 *
 * Filters run in the threads of vtkSMPTools (in those of TBB where the backend is Sequential by default rather than by choice)
 * and give the same bits for any number of threads. An aborted run leaves empty outputs, and so does an error, as a number out of
 * its range is.
 *
 * On several ranks (vtkMultiProcessController), a vtkPolyData or vtkUnstructuredGrid in pieces is gathered on the first rank,
 * which holds the whole result; the other ranks are empty. Points of different pieces are one by global ids, or at the same
 * place. Guides and other inputs are gathered as well. Equal pieces, as where each rank reads the whole file, are one. Field data
 * (string, Gathered) and a line of VTK's output say so, with the memory that it takes. Where the first rank has not that much,
 * there is an error with the numbers; DMG_MEMORY_LIMIT (in KiB) in the environment caps the memory that gathering may use. An error
 * or an abort on one rank ends all. The first rank asks for the whole of grids and of the leaves of composite datasets.
 *
 * @sa vtkFieldDrawingAlgorithm
 */

#ifndef vtkOrientedSurfaceAlgorithm_h
#define vtkOrientedSurfaceAlgorithm_h

#include "vtkDataSetAlgorithm.h"
#include "vtkFiltersDirectionalFieldsModule.h" // For export macro

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkOrientedSurfaceAlgorithm : public vtkDataSetAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkOrientedSurfaceAlgorithm, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether points of the boundary that coincide are joined: those that are equal, or nearer to each other than the rounding of coordinates,
   * and than a hundredth of the edges there. The rounding is that of single precision; of coordinates in double precision, as
   * those of a national grid, that which the surface would have in single precision around the origin. So seams close, as those of ParaView's
   * Cylinder, soups of triangles become surfaces, and cells that are there twice count once. Gaps and walls that are wider stay. Default on.
   */
  vtkSetMacro(JoinPoints, bool);
  vtkGetMacro(JoinPoints, bool);
  vtkBooleanMacro(JoinPoints, bool);
  ///@}

  ///@{
  /**
   * Whether a surface that is not an oriented manifold is an error, which says why, instead of being repaired inside. No points
   * are joined then. Default off.
   */
  vtkSetMacro(Strict, bool);
  vtkGetMacro(Strict, bool);
  vtkBooleanMacro(Strict, bool);
  ///@}

  vtkOrientedSurfaceAlgorithm(const vtkOrientedSurfaceAlgorithm&) = delete;
  void operator=(const vtkOrientedSurfaceAlgorithm&) = delete;

protected:
  vtkOrientedSurfaceAlgorithm() = default;
  ~vtkOrientedSurfaceAlgorithm() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

  bool JoinPoints = true;
  bool Strict = false;
};

#endif

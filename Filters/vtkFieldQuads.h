/**
 * @class   vtkFieldQuads
 * @brief   a mesh of quads alone whose edges follow a cross field
 *
 * vtkFieldQuads turns any surface into a mesh of quads. Their edges follow a cross field: one that the surface has in its arrays, or the
 * smoothest one, which follows the boundary and sharp edges. The mesh is manifold and has the Euler characteristic of the surface, so no
 * hole, handle or component is lost; where quads of the size that is wanted would lose one, they are smaller there.
 *
 * The method: a map to the plane is found whose gradients follow the field and whose integer grid continues over all of its cuts. The lines at
 * half-integers cross each other once for each quad. See Core/Quads/Quads.md.
 *
 * @section vtkFieldQuads-Inputs Inputs
 *
 * Port 0: a surface with a field as vtkFieldDrawingAlgorithm describes it. Without a choice and without an array Direction0, the smoothest
 * cross field is found. A field of 4 directions is a cross field. Of a field of 1 or 2, as vectors or principal directions, edges run
 * along the lines and across. Others are refused. Where it has gaps, as masked data have, the smoothest one fills them.
 *
 *   SetInputArrayToProcess(1, 0, 0, association, name)
 *
 * chooses an array of positive numbers on cells or points, the length of edges there relative to other places. By default it is the same
 * everywhere. A field that is found here turns with the sizes, so that lengths vary as much as they should. A given one is kept, which leaves room for a part
 * of that; a warning tells the ratio that was asked for, the one that was reached, and the way to more.
 *
 *   SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, name)
 *
 * chooses an array of numbers on cells, as materials or polygroups: borders between cells of different ones become edges of quads, so that each quad
 * has the number of its region.
 *
 * @section vtkFieldQuads-Outputs Outputs
 *
 * Port 0, the quads: vtkPolyData. The arrays of points of the surface are interpolated at its points, and those of integers and of texts, which are
 * labels, are taken from the nearest point; a quad has the arrays of a cell below it. Active arrays stay active: texture coordinates, scalars,
 * vectors, tensors, and normals, which are unit vectors. Global ids and ghosts are left out. A quad across the seam of a texture has
 * coordinates from both of its sides. Where the surface has no normals, the quads have none, as points at sharp edges have several: quads are
 * shaded as flat, and vtkPolyDataNormals with Splitting on makes normals, which doubles these points. Besides,
 *
 * | array          | of     | components | type   | meaning                                                         |
 * | -------------- | ------ | ---------- | ------ | --------------------------------------------------------------- |
 * | Irregular      | points | 1          | int    | number of quads less 4; 0 on the boundary                       |
 * | ScaledJacobian | cells  | 1          | double | least sine of the corners, 1 for rectangles, < 0 if inverted    |
 * | CornersOnGrid  | cells  | 8          | double | u and v of its corners: each quad is a square of an integer grid that is cut between irregular points |
 * | GridCoordinates | points | 2         | float | only with CutForTextures: the same at points; texture coordinates, where the surface has no active ones |
 *
 * The field data say, of distances: DistanceFromQuads of the surface, largest and mean; FarthestPlace, where it is largest; and
 * DistanceFromSurface of the quads, largest and mean. AreaShares has by component the area of quads over that of the surface, and
 * RatioOfSizes the largest over the smallest length of edges, asked for and reached. An int each: Singularities of the field, IrregularVertices, IrregularWithoutSingularity, FlippedTriangles
 * and TrianglesWithoutArea of the map, InvertedQuads, EdgesAgainstField of the boundary and between regions that edges of quads follow though the field does not, LostRegions that no quad has, EulerCharacteristicOfSurface, EulerCharacteristic, RefinedTriangles where quads are smaller, SplitTriangles of
 * components that no other quads fit. Of symmetric quads, SymmetryPlane is a place of the plane and its unit normal, six numbers.
 *
 * Port 1, the map: vtkPolyData, the triangles of the surface with its arrays and TextureCoordinates, where points are doubled along cuts. Edges
 * longer than those of quads are halved, as a map has no room to bend within large triangles.
 * A texture that repeats shows the grid.
 *
 * Port 2, the irregular vertices: vtkPolyData, a ball for each vertex inside of the mesh that has not four quads, with the arrays
 * Irregular and SignColor.
 *
 * @section vtkFieldQuads-Execution Execution
 *
 * All is done anew in each execution. It takes a sparse factor of a Laplacian with two unknowns per point, and the cube of the number of
 * singularities, handles and holes. A component that quads of the size cannot keep is split into three quads for each triangle, with a
 * warning, if its triangles are few. Else there is an error that names the place and says how many would keep it, and port 1 alone has data.
 *
 * @sa vtkHarmonicFieldSolver vtkFieldSingularities
 */

#ifndef vtkFieldQuads_h
#define vtkFieldQuads_h

#include "vtkFieldDrawingAlgorithm.h"
#include "vtkFiltersDirectionalFieldsModule.h" // For export macro

#include <string>

namespace dmg
{
class PropertyTable;
struct QuadOptions;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldQuads : public vtkFieldDrawingAlgorithm
{
public:
  static vtkFieldQuads* New();
  vtkTypeMacro(vtkFieldQuads, vtkFieldDrawingAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of quads that is aimed at, where EdgeLength is 0. Default 4000, range 1 to 900000.
   */
  vtkSetMacro(NumberOfQuads, int);
  vtkGetMacro(NumberOfQuads, int);
  ///@}

  ///@{
  /**
   * The length of edges, in the unit of the points; 0, the default: by NumberOfQuads. Range 0 to 1e40.
   */
  vtkSetMacro(EdgeLength, double);
  vtkGetMacro(EdgeLength, double);
  ///@}

  ///@{
  /**
   * How much shorter edges are where the surface bends, at the same number of quads. 0, the default, is not at all; with 1, they are as long as the
   * radius of the larger curvature tells, down to about an eighth of those on flat parts. Sharp edges that become edges of quads do not count. Times the array of
   * sizes, where there is one. Range 0 to 1.
   */
  vtkSetMacro(Adaptivity, double);
  vtkGetMacro(Adaptivity, double);
  ///@}

  ///@{
  /**
   * Whether the boundary becomes edges of quads. Default on.
   */
  vtkSetMacro(AlignBoundary, bool);
  vtkGetMacro(AlignBoundary, bool);
  vtkBooleanMacro(AlignBoundary, bool);
  ///@}

  ///@{
  /**
   * Whether sharp edges become edges of quads, where the field follows them within 25 degrees and they are no noise: part of lines of a
   * tenth of the diagonal of the surface's box at least, and of a fiftieth between two ends, branches or bends. Default on.
   */
  vtkSetMacro(AlignSharpEdges, bool);
  vtkGetMacro(AlignSharpEdges, bool);
  vtkBooleanMacro(AlignSharpEdges, bool);
  ///@}

  ///@{
  /**
   * Edges with a larger angle between the normals of their faces, in degrees, are sharp. Default 30, range 0 to 180.
   */
  vtkSetMacro(FeatureAngle, double);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  enum SymmetryKinds
  {
    NoSymmetry = 0,
    /**
     * About the plane that fits best, where the surface is its own mirror image about it to a fiftieth of the diagonal of its box.
     */
    Automatic = 1,
    /**
     * About the plane of SymmetryOrigin and SymmetryNormal, under the same condition.
     */
    Plane = 2,
  };

  ///@{
  /**
   * Whether the quads are their own mirror image, to rounding, with edges along the plane. The half that the normal of the plane points to is
   * meshed, with the plane as an aligned boundary, and mirrored; all other boundary is aligned, too. Where the surface is not symmetric, a
   * warning tells by how much, and the quads are not. The map, port 1, is that of the half. Default NoSymmetry.
   */
  vtkSetMacro(Symmetry, int);
  vtkGetMacro(Symmetry, int);
  ///@}

  ///@{
  /**
   * A place in the plane of symmetry, and its normal of any length but zero. Default (0, 0, 0) and (1, 0, 0).
   */
  vtkSetVector3Macro(SymmetryOrigin, double);
  vtkGetVector3Macro(SymmetryOrigin, double);
  vtkSetVector3Macro(SymmetryNormal, double);
  vtkGetVector3Macro(SymmetryNormal, double);
  ///@}

  ///@{
  /**
   * Steps in which vertices are smoothed along the surface. 0 leaves them where the map has integers. Default 6, range 0 to 1000.
   */
  vtkSetMacro(SmoothingSteps, int);
  vtkGetMacro(SmoothingSteps, int);
  ///@}

  ///@{
  /**
   * Whether points are doubled along the cuts of the integer grid, so that each has its own GridCoordinates, by which a texture that repeats shows
   * as squares. Without, the mesh is in one piece, and CornersOnGrid of cells has the same numbers. Default off.
   */
  vtkSetMacro(CutForTextures, bool);
  vtkGetMacro(CutForTextures, bool);
  vtkBooleanMacro(CutForTextures, bool);
  ///@}

  ///@{
  /**
   * Radius of the balls of port 2, over the length of edges. Default 0.5, range 0 to 10.
   */
  vtkSetMacro(BallRadius, double);
  vtkGetMacro(BallRadius, double);
  ///@}

  /**
   * One line about the last update: the numbers of quads, irregular vertices and inverted quads. Empty before, and after an error.
   */
  const char* GetSummary() const;

  vtkFieldQuads(const vtkFieldQuads&) = delete;
  void operator=(const vtkFieldQuads&) = delete;

protected:
  vtkFieldQuads();
  ~vtkFieldQuads() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;
  dmg::QuadOptions Options() const;

  int NumberOfQuads = 4000;
  double EdgeLength = 0.0;
  double Adaptivity = 0.0;
  bool AlignBoundary = true;
  bool AlignSharpEdges = true;
  bool CutForTextures = false;
  double FeatureAngle = 30.0;
  int Symmetry = NoSymmetry;
  double SymmetryOrigin[3] = { 0.0, 0.0, 0.0 };
  double SymmetryNormal[3] = { 1.0, 0.0, 0.0 };
  int SmoothingSteps = 6;
  double BallRadius = 0.5;
  std::string Summary;
};

#endif

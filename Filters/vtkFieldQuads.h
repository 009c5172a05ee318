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
 * along the lines and across. Others are refused.
 *
 *   SetInputArrayToProcess(1, 0, 0, association, name)
 *
 * chooses an array of positive numbers on cells or points, the length of edges there relative to other places. By default it is the same
 * everywhere.
 *
 * @section vtkFieldQuads-Outputs Outputs
 *
 * Port 0, the quads: vtkPolyData. The arrays of points of the surface are interpolated at its points, and a quad has the arrays of a cell
 * below it. It has no normals, as points at sharp edges have several: quads are shaded as flat, and vtkPolyDataNormals with Splitting on
 * makes normals, which doubles these points. Besides,
 *
 * | array          | of     | components | type   | meaning                                                         |
 * | -------------- | ------ | ---------- | ------ | --------------------------------------------------------------- |
 * | Irregular      | points | 1          | int    | number of quads less 4; 0 on the boundary                       |
 * | ScaledJacobian | cells  | 1          | double | least sine of the corners, 1 for rectangles, <= 0 if inverted   |
 *
 * The field data say, of distances: DistanceFromQuads of the surface, largest and mean; FarthestPlace, where it is largest; and
 * DistanceFromSurface of the quads, largest and mean. AreaShares has by component the area of quads over that of the surface, and
 * RatioOfSizes the largest over the smallest length of edges, asked for and reached. An int each: Singularities of the field, IrregularVertices, IrregularWithoutSingularity, FlippedTriangles
 * of the map, InvertedQuads, EulerCharacteristicOfSurface, EulerCharacteristic, RefinedTriangles where quads are smaller, SplitTriangles of
 * components that no other quads fit.
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

  ///@{
  /**
   * Steps in which vertices are smoothed along the surface. 0 leaves them where the map has integers. Default 6, range 0 to 1000.
   */
  vtkSetMacro(SmoothingSteps, int);
  vtkGetMacro(SmoothingSteps, int);
  ///@}

  ///@{
  /**
   * Radius of the balls of port 2, over the length of edges. Default 0.25, range 0 to 10.
   */
  vtkSetMacro(BallRadius, double);
  vtkGetMacro(BallRadius, double);
  ///@}

  vtkFieldQuads(const vtkFieldQuads&) = delete;
  void operator=(const vtkFieldQuads&) = delete;

protected:
  vtkFieldQuads();
  ~vtkFieldQuads() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  int NumberOfQuads = 4000;
  double EdgeLength = 0.0;
  bool AlignBoundary = true;
  bool AlignSharpEdges = true;
  double FeatureAngle = 30.0;
  int SmoothingSteps = 6;
  double BallRadius = 0.25;
};

#endif

/**
 * @class   vtkParallelTransport
 * @brief   directions carried over a surface along shortest paths, and polar coordinates around a point
 *
 * Vectors that are given at a few places are carried to everywhere: each place takes the vector of the nearest source, which keeps its
 * angle to the shortest path. The logarithmic map of a point gives each place
 * the direction in which the shortest path to it starts, and its length: coordinates for decals and polar plots, with little distortion
 * near the point (angles by the affine heat method, Soliman and Sharp 2025). Filters/Core/Geodesics/ParallelTransport.md has the formulas.
 *
 * @section vtkParallelTransport-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it. The sources are one of these, the last one also beside others (AddPoint):
 *
 * - an array of vectors of cells or points, chosen by SetInputArrayToProcess(0, 0, 0, association, name); by default none. A vector counts
 *   where it is finite and not zero; its tangential part is carried, with its length. In a plane of constant z they may have 2 components.
 *   Fill values are an error or a warning, as of vtkHodgeDecomposition.
 * - eastward and northward components of cells or points, chosen with indices 1 and 2, for surfaces around the origin with Axis to the
 *   north. They count where index 1 is chosen, instead of vectors.
 * - Direction at a point of the surface, where no array is chosen or where AddPoint is on: the one that is nearest to Point or, as long as
 *   nobody has set Point, one that the filter chooses (UsePoint).
 *
 * @section vtkParallelTransport-Output Output
 *
 * Port 0: of the type of the input, with all its arrays, and, as double but for TextureCoordinates, which are float:
 *
 * | array              | of            | components | meaning                                                                       |
 * | ------------------ | ------------- | ---------- | ----------------------------------------------------------------------------- |
 * | TransportedVectors | cells, points | 3          | tangential, of the length of the source; active vectors of points             |
 * | GeodesicDistance   | points        | 1          | from the map's point along the surface; active scalars                        |
 * | GeodesicAngle      | points        | 1          | of the shortest path at the map's point, from Direction counter-clockwise seen from PositiveSide, in degrees from -180 to 180 |
 * | LogarithmicMap     | points        | 2          | distance times (cosine, sine) of the angle: normal coordinates                |
 * | TextureCoordinates | points        | 2          | 0.5 + LogarithmicMap / TextureSize: an image with the point in its middle; active texture coordinates |
 * | MapPoint           | field data    | 1          | the point of the input that is the map's                                      |
 * | PointsWithoutSource | field data   | 1          | those on components without a source, where vectors are zero                  |
 * | PointsWithoutMap   | field data    | 1          | those on components without the map's point                                   |
 * | PositiveSide       | field data    | 1          | see vtkOrientedSurfaceAlgorithm                                               |
 *
 * Port 1, the arrows: vtkPolyData, the output of vtkFieldGlyphs for TransportedVectors, at ArrowDistance.
 *
 * Port 2, the circles: vtkPolyData, lines of NumberOfCircles distances, evenly spaced, with the point array GeodesicDistance.
 *
 * Distances go around holes. Components of the surface without a source have zero vectors, and those without the map's point NaN;
 * field data counts their points. So have points of no cell of two dimensions. Coordinates jump where shortest paths from different sides
 * meet, as on the far side of the surface. A triangle across such a place shows the whole texture; take it away with Threshold of
 * GeodesicDistance.
 *
 * @section vtkParallelTransport-Execution Execution
 *
 * The map takes sparse factors, made once for a surface and a time step, and kept: a moved point then costs some solves. Vectors take none.
 * Blocks of composite inputs are surfaces of their own, each with a point of its own.
 *
 * @sa vtkHarmonicFieldSolver
 */

#ifndef vtkParallelTransport_h
#define vtkParallelTransport_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

#include <memory> // For std::unique_ptr

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkParallelTransport : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkParallelTransport* New();
  vtkTypeMacro(vtkParallelTransport, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A place whose nearest point of the surface is the point of the logarithmic map, and the source of Direction. To set it switches
   * UsePoint on. Default (0, 0, 0), which is not used.
   */
  void SetPoint(double x, double y, double z);
  void SetPoint(const double point[3]) { this->SetPoint(point[0], point[1], point[2]); }
  void SetPointOfPanel(double x, double y, double z); ///< leaves UsePoint as it is, which ParaView sets, too
  vtkGetVector3Macro(Point, double);
  ///@}

  ///@{
  /**
   * Whether Point is used. Else the filter chooses the point of the map: on the component of the surface that has the largest area, the
   * point nearest to the middle of the front of its bounds, where z is largest, so that nothing of that component hides it from whoever
   * looks along -z. Default off, until Point is set.
   */
  vtkSetMacro(UsePoint, bool);
  vtkGetMacro(UsePoint, bool);
  vtkBooleanMacro(UsePoint, bool);
  ///@}

  ///@{
  /**
   * The point of the surface that was the map's in the last execution. It is not a number where there was none, or several, one for each
   * block, and on all ranks but the first. No output changes where Point is set to it.
   */
  vtkGetVector3Macro(PointOnSurface, double);
  ///@}

  ///@{
  /**
   * The vector that is carried from there, and the zero of GeodesicAngle; its tangential part counts. Any direction takes its place, with a
   * warning, where it is perpendicular to the surface. Default (1, 0, 0). (0, 0, 0) is an error.
   */
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

  ///@{
  /**
   * Whether Direction is a source beside the vectors of an array. Without such an array it always is. Default off.
   */
  vtkSetMacro(AddPoint, bool);
  vtkGetMacro(AddPoint, bool);
  vtkBooleanMacro(AddPoint, bool);
  ///@}

  ///@{
  /**
   * Whether the logarithmic map is computed: distance, angle and coordinates. Default on.
   */
  vtkSetMacro(LogarithmicMap, bool);
  vtkGetMacro(LogarithmicMap, bool);
  vtkBooleanMacro(LogarithmicMap, bool);
  ///@}

  ///@{
  /**
   * The direction to the north pole from the origin, for eastward and northward components; of any length but zero. Default (0, 0, 1).
   */
  vtkSetVector3Macro(Axis, double);
  vtkGetVector3Macro(Axis, double);
  ///@}

  ///@{
  /**
   * The side of the square, in the unit of the points, that an image covers by TextureCoordinates. 0: twice the largest distance, so that all
   * of the surface is in the image. Default 0, at least 0.
   */
  vtkSetMacro(TextureSize, double);
  vtkGetMacro(TextureSize, double);
  ///@}

  ///@{
  /**
   * The distance between the arrows of port 1, relative to the surface's size (vtkFieldGlyphs::SeparatingDistance). Default 0.04, range
   * 0.0005 to 1.
   */
  vtkSetMacro(ArrowDistance, double);
  vtkGetMacro(ArrowDistance, double);
  ///@}

  ///@{
  /**
   * The number of distances that have lines on port 2. Default 20, range 0 (none) to 1000.
   */
  vtkSetMacro(NumberOfCircles, int);
  vtkGetMacro(NumberOfCircles, int);
  ///@}

  ///@{
  /**
   * The time of the diffusion by which the map finds angles, as a multiple of the mean squared edge length. With more, heat takes ways beside
   * the shortest one. With less, the edges of the mesh bend its way. Default 2, range 0.01 to 1000.
   */
  vtkSetMacro(TimeStep, double);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /**
   * The numbers of times that this object has factored matrices, and solved for vectors or a map.
   */
  int GetNumberOfSetups() const;
  int GetNumberOfSolves() const;
  ///@}

  vtkParallelTransport(const vtkParallelTransport&) = delete;
  void operator=(const vtkParallelTransport&) = delete;

protected:
  vtkParallelTransport();
  ~vtkParallelTransport() override;

  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  double Point[3] = { 0.0, 0.0, 0.0 };
  double Axis[3] = { 0.0, 0.0, 1.0 };
  bool UsePoint = false;
  double PointOnSurface[3];
  double Direction[3] = { 1.0, 0.0, 0.0 };
  bool AddPoint = false;
  bool LogarithmicMap = true;
  double TextureSize = 0.0;
  double ArrowDistance = 0.04;
  int NumberOfCircles = 20;
  double TimeStep = 2.0;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

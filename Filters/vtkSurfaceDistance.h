/**
 * @class   vtkSurfaceDistance
 * @brief   distances along a surface from anything, with signs, nearest sources, offset lines and shortest paths
 *
 * Distances are those of the shortest way over the surface, not through space and not along the edges of its mesh. They are exact in planes
 * and on what unfolds into one, from points anywhere and from straight lines, and of second order on smooth surfaces.
 * Filters/Core/Geodesics/SurfaceDistance.md has the method and its limits.
 *
 * @section vtkSurfaceDistance-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it, or a flat map (SetCoordinates). Distance is 0 at the sources, which are all of
 * these:
 *
 * - port 1 (optional, any number of connections): vtkDataSet, or composite datasets of these. Each vertex cell is a point, each line or
 *   polyline a line, and polygons are their outline, a closed line. A dataset without any of these is its points. They are brought to the
 *   nearest place of the surface, between its points as well; what is farther than MaximumSourceDistance, or on the far side of a thin wall, is
 *   left out, with a warning. Lines of two points that follow each other by their numbers are one.
 * - a mask, an array of one number for cells or points, chosen by SetInputArrayToProcess(0, 0, 0, association, name): where it is neither zero
 *   nor NaN. Cells, and cells all of whose points are chosen, are a region: Distance is 0 inside. Other points are sources on their own.
 * - Boundary: the boundary of the surface; SharpEdges: edges with an angle of more than FeatureAngle.
 * - Point, where none of these is asked for, or where AddPoint is on: the place of the surface that is nearest to it or, as long as nobody has set
 *   Point, a point that the filter chooses (UsePoint).
 *
 * Port 2 (optional, any number of connections): targets. A shortest path leads from the nearest source to each of their points, which are
 * brought to the surface as well.
 *
 * An array with index 1 says where the surface has gaps, as land in the sea: cells where it is NaN, or with such a point, take no part.
 *
 * @section vtkSurfaceDistance-Output Output
 *
 * Port 0: of the type of the input, with all its arrays, and (lengths are in the unit of the points times LengthScale):
 *
 * | array               | of         | components | type   | meaning |
 * | ------------------- | ---------- | ---------- | ------ | ------- |
 * | Distance            | points     | 1          | double | from the nearest source; negative inside (SetSigned); NaN where no path leads, or where it is longer than MaximumDistance; active scalars |
 * | NearestSource       | points     | 1          | int    | its number, so that points with one number are its Voronoi cell; -1 where Distance is NaN |
 * | DirectionFromSource | points     | 3          | double | unit, tangential: the direction in which the shortest path arrives; zero at sources, and where Distance is NaN |
 * | SourcesTaken        | field data | 1          | double | the number of sources |
 * | SourcesTooFar       | field data | 1          | double | points, and segments of lines, that were left out |
 * | PointsWithoutSource | field data | 1          | double | points of the surface where Distance is NaN |
 * | LargestDistance     | field data | 1          | double | without its sign |
 * | DistanceIsSigned    | field data | 1          | double | 1 where distances inside are negative |
 * | PositiveSide        | field data | 1          | string | see vtkHodgeDecomposition; from there, lines have their inside to the left |
 * | CellsWithoutData    | field data | 1          | double | cells that took no part, where an array says so |
 *
 * Sources are numbered in this order: points of a mask that are no region; points of port 1; Point; lines and outlines of port 1; the region; the
 * boundary; sharp edges. The last three have a number each, whether they are there or not.
 *
 * Port 1, the offset lines: vtkPolyData, lines with the point array Distance, at OffsetDistances or, where there are none, at NumberOfLevels
 * distances, evenly spaced. Closed lines end at their first point.
 *
 * Port 2, the paths: vtkPolyData, a polyline from source to target for each target that a path leads to, with the cell arrays of the table. Paths
 * are locally shortest; behind a hill there may be a shorter one around its other side, by some thousandths.
 *
 * Port 3, the table: vtkTable, a row for each point of port 2, with the columns Target, its number; Source, the number of the source, -1 where
 * no path leads; Distance; PathLength, which is the same but for errors of both; StraightLength, between the ends of the path through space. NaN where
 * no path leads. From a line, paths start at its nearest place.
 *
 * @section vtkSurfaceDistance-Execution Execution
 *
 * Distances are kept: other targets and other offset lines need no new ones. Blocks of composite inputs are surfaces of their own: a block that no source is near to has no
 * distances.
 *
 * @sa vtkParallelTransport
 */

#ifndef vtkSurfaceDistance_h
#define vtkSurfaceDistance_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

#include <memory> // For std::unique_ptr
#include <vector> // For std::vector

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkSurfaceDistance : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkSurfaceDistance* New();
  vtkTypeMacro(vtkSurfaceDistance, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Adds sources (port 1) or targets (port 2), or takes all of them away.
   */
  void AddSourcesConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(1, output); }
  void RemoveAllSources() { this->SetInputConnection(1, nullptr); }
  void AddTargetsConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(2, output); }
  void RemoveAllTargets() { this->SetInputConnection(2, nullptr); }
  ///@}

  ///@{
  /**
   * Whether the boundary of the surface is a source. Default off.
   */
  vtkSetMacro(Boundary, bool);
  vtkGetMacro(Boundary, bool);
  vtkBooleanMacro(Boundary, bool);
  ///@}

  ///@{
  /**
   * Whether sharp edges are a source: those whose faces have an angle of more than FeatureAngle between them, in degrees. Default off, and
   * 30, range 0.001 to 180.
   */
  vtkSetMacro(SharpEdges, bool);
  vtkGetMacro(SharpEdges, bool);
  vtkBooleanMacro(SharpEdges, bool);
  vtkSetMacro(FeatureAngle, double);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * A place whose nearest place of the surface is a source, where no others are asked for or where AddPoint is on. To set it switches UsePoint
   * on. Default (0, 0, 0), which is not used.
   */
  void SetPoint(double x, double y, double z);
  void SetPoint(const double point[3]) { this->SetPoint(point[0], point[1], point[2]); }
  void SetPointOfPanel(double x, double y, double z); ///< leaves UsePoint as it is, which ParaView sets, too
  vtkGetVector3Macro(Point, double);
  ///@}

  ///@{
  /**
   * Whether Point is used. Else the filter chooses a point: that of vtkParallelTransport, on the largest component, near the middle of its front.
   * Default off, until Point is set.
   */
  vtkSetMacro(UsePoint, bool);
  vtkGetMacro(UsePoint, bool);
  vtkBooleanMacro(UsePoint, bool);
  ///@}

  ///@{
  /**
   * The point of the surface that the filter has chosen in the last execution. It is not a number where it has not, or several, one for each
   * block, and on all ranks but the first. No output changes where Point is set to it.
   */
  vtkGetVector3Macro(PointOnSurface, double);
  ///@}

  ///@{
  /**
   * Whether Point is a source beside others. Without others it always is. Default off.
   */
  vtkSetMacro(AddPoint, bool);
  vtkGetMacro(AddPoint, bool);
  vtkBooleanMacro(AddPoint, bool);
  ///@}

  ///@{
  /**
   * Whether distances are negative inside: in the region, in polygons, and to the left of lines, seen from PositiveSide, where these part the
   * surface. Points have no inside, and a loop around a handle has none: then a warning says that distances have no sign. Default off.
   */
  vtkSetMacro(Signed, bool);
  vtkGetMacro(Signed, bool);
  vtkBooleanMacro(Signed, bool);
  ///@}

  ///@{
  /**
   * Distances beyond it are not computed, which saves time. 0: there is no limit. Default 0, at least 0.
   */
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  ///@{
  /**
   * Sources on port 1, and targets, that are farther from the surface are left out; relative to the diagonal of its bounding box. Default 0.1, at
   * least 0.
   */
  vtkSetMacro(MaximumSourceDistance, double);
  vtkGetMacro(MaximumSourceDistance, double);
  ///@}

  ///@{
  /**
   * The distances of offset lines. Any order; negative ones where distances have signs. A distance beyond MaximumDistance is an error. Default
   * none: NumberOfLevels.
   */
  void AddOffsetDistance(double distance);
  void RemoveAllOffsetDistances();
  int GetNumberOfOffsetDistances() const { return static_cast<int>(this->OffsetDistances.size()); }
  double GetOffsetDistance(int index) const; ///< NaN where there is none of that index
  ///@}

  ///@{
  /**
   * The number of offset lines where no OffsetDistances are given, evenly spaced. Default 20, range 0 (none) to 1000.
   */
  vtkSetMacro(NumberOfLevels, int);
  vtkGetMacro(NumberOfLevels, int);
  ///@}

  enum CoordinateKinds
  {
    /** The points are places in space. */
    Space = 0,
    /** The surface, its sources and targets are on a flat map: x is the longitude and y the latitude, in degrees. Distances are on the unit sphere. */
    LongitudeAndLatitude = 1
  };

  ///@{
  /**
   * The meaning of the coordinates of all points. On a map, directions are (eastward, northward, upward). Default Space.
   */
  vtkSetMacro(Coordinates, int);
  vtkGetMacro(Coordinates, int);
  ///@}

  ///@{
  /**
   * The length of the unit of the points: 6371 for the Earth as a map, so that distances are in km. MaximumDistance and OffsetDistances are in the
   * same unit. Default 1, between 1e-30 and 1e30.
   */
  vtkSetMacro(LengthScale, double);
  vtkGetMacro(LengthScale, double);
  ///@}

  /**
   * The number of times that this object has found distances; where only targets or offset lines have changed, it has not.
   */
  int GetNumberOfSetups() const;

  vtkSurfaceDistance(const vtkSurfaceDistance&) = delete;
  void operator=(const vtkSurfaceDistance&) = delete;

protected:
  vtkSurfaceDistance();
  ~vtkSurfaceDistance() override;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;

  bool Boundary = false;
  bool SharpEdges = false;
  double FeatureAngle = 30.0;
  double Point[3] = { 0.0, 0.0, 0.0 };
  bool UsePoint = false;
  double PointOnSurface[3];
  bool AddPoint = false;
  bool Signed = false;
  double MaximumDistance = 0.0;
  double MaximumSourceDistance = 0.1;
  std::vector<double> OffsetDistances;
  int NumberOfLevels = 20;
  int Coordinates = Space;
  double LengthScale = 1.0;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

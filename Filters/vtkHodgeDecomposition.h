/**
 * @class   vtkHodgeDecomposition
 * @brief   stream function, potential and harmonic part of a flow on a surface
 *
 * A flow on a surface is the sum of a part without vortices, the gradient of a potential; a part without sources, the gradient
 * of a stream function after a quarter turn counter-clockwise; a harmonic part with neither, around handles and holes; and a
 * residual, which varies from cell to cell and is too fine for the mesh. The parts are orthogonal to each other in the
 * integral over the surface, so that their energies sum to that of the flow (Filters/Core/Flows/HodgeDecomposition.md has the proof).
 *
 * @section vtkHodgeDecomposition-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it, with a flow in one of these forms:
 *
 * - vectors of cells or points, chosen by SetInputArrayToProcess(0, 0, 0, association, name); by default the active vectors of points,
 *   else of cells. Their tangential part is decomposed. In a plane of constant z they may have 2 components. A face has the mean of
 *   vectors at its corners, of its own points where several were joined.
 * - eastward and northward components of cells or points, chosen with indices 1 and 2, for surfaces around the origin with Axis to the
 *   north, or for flat maps (Coordinates). They count where index 1 is chosen, instead of vectors. On the axis, the flow is the mean of
 *   the neighbours.
 *
 * A cell with a number that is NaN, or with such a point, has no flow, as land: it takes no part, and is NaN in what comes out. Fill
 * values (1e20, -9999, infinite) far from the others are an error or a warning. Vectors of a cell stand at the mean of its corners, each as often as it is written.
 *
 * Port 1 (optional): the flow as a 1-form instead. A dataset with a line for each edge of the surface, whose points are numbered as
 * those of the surface or lie where these are, and the cell array EdgeArray: numbers for the way from the first point of a line to the
 * second (EdgeValues). Diagonals of polygons may be left out. Lines elsewhere are passed over. Examples:
 *
 * - the second output of vtkHarmonicFieldSolver with its array OneForm;
 * - velocities of C-grid models, such as MPAS: the component of the flow that is normal to the side between two cells goes along the line
 *   between their centres. The surface is the triangulation whose points are these centres.
 *
 * A 1-form that is closed, as the differences of a function, has vectors without vorticity, to rounding. Else a face has the vector of
 * the Whitney interpolant at its centre.
 *
 * @section vtkHodgeDecomposition-Output Output
 *
 * Port 0: of the type of the input, with all its arrays, and, as double (L is LengthScale, lengths are in the unit of the points times L):
 *
 * | array                                                 | of             | components | meaning                                        |
 * | ----------------------------------------------------- | -------------- | ---------- | ---------------------------------------------- |
 * | GradientPart, RotationalPart, HarmonicPart, Residual  | cells, points  | 3          | the parts, in the unit of the flow             |
 * | SteeringFlow                                          | cells, points  | 3          | what the boundary alone decides (SetSteeringFlow) |
 * | Potential                                             | points         | 1          | flow times length; grows along GradientPart    |
 * | StreamFunction                                        | points         | 1          | grows to the right of RotationalPart; active scalars |
 * | Divergence, Vorticity                                 | points         | 1          | flow over length; counter-clockwise is positive, seen from PositiveSide; NaN in straits one cell wide |
 * | NormalComponent                                       | cells          | 1          | of vectors, what is not tangential, seen from PositiveSide; none of a 1-form |
 *
 * On triangles, parts sum to the tangential part of the flow; other cells have the mean of their triangles. At points, they are
 * means of the cells around, by angle. Where a function is free by a constant, its mean over the area of each component of the
 * surface is zero.
 *
 * Field data:
 *
 * | array                                       | tuples     | meaning                                                              |
 * | ------------------------------------------- | ---------- | -------------------------------------------------------------------- |
 * | FlowEnergies                                | 5          | squared speed integrated: of the flow, gradient, rotational, harmonic part, residual |
 * | FlowShares                                  | 4          | of the parts in the first                                            |
 * | HarmonicCoefficients                        | dimension  | of the harmonic part in an orthonormal basis                         |
 * | BoundaryPoint, BoundaryLength               | boundaries | a point of each loop, and its length; of a component the longest first |
 * | BoundaryIsOpen                              | boundaries | 1 for open ones                                                      |
 * | BoundaryCirculation                         | boundaries | along it, with the surface to the left: clockwise around an island |
 * | BoundaryFlux                                | boundaries | out of the surface                                                   |
 * | BoundaryStreamFunction                      | boundaries | differences are transports between coasts; on open boundaries a mean |
 * | CellsWithoutFlow                            | 1          | cells that took no part                                              |
 * | PositiveSide                                | 1          | see vtkOrientedSurfaceAlgorithm |
 * | Solver, Converged, SolverBytes              | 1          | see Filters/HarmonicFieldSolver.md                                   |
 *
 * Port 1: vtkPolyData, polylines where the stream function has one of NumberOfContours values, evenly spaced between its extremes: the
 * streamlines of the rotational part, in its direction, each pair with the same transport between them. They have StreamFunction at
 * their points.
 *
 * Port 2: vtkPolyData, a line for each boundary, in the order of field data, with the cell arrays Boundary (its number), those of field
 * data, and BoundaryTransport: the stream function less that of
 * ReferenceBoundary, which is the transport through a section from there to this boundary. Other components than that of ReferenceBoundary
 * have it against their own longest boundary.
 *
 * Parts that are switched off have no arrays, and are in the residual.
 *
 * @section vtkHodgeDecomposition-Execution Execution
 *
 * Two solves for each flow; one more, once, for each island, and for each open part and loop around handles and holes (HarmonicPart).
 * Divergence and vorticity take no solve. Set-up and harmonic fields are kept for the next flow on the same surface, as in a time series, whose
 * times pass through. Where no flow is chosen, the first output is the input, beside the error.
 *
 * @sa vtkHarmonicFieldSolver
 */

#ifndef vtkHodgeDecomposition_h
#define vtkHodgeDecomposition_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkHodgeDecomposition : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkHodgeDecomposition* New();
  vtkTypeMacro(vtkHodgeDecomposition, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The name of the cell array of lines on port 1 that holds the flow. Default OneForm.
   */
  vtkSetStdStringFromCharMacro(EdgeArray);
  vtkGetCharFromStdStringMacro(EdgeArray);
  ///@}

  enum EdgeValueKinds
  {
    /** The integral of the flow along the line: flow times length, in the unit of the points. */
    Integrals = 0,
    /**
     * The component of the flow along the line, in the unit of the flow: the integral is that times the length. The surface between the
     * centres of a C-grid's cells ends half a cell before each coast, and transports lack what flows there: of an even flow between two
     * coasts with N cells, one part in N. The field data array BoundaryHalfCell has the width of that strip for each boundary.
     */
    Components = 1
  };

  ///@{
  /**
   * The meaning of the numbers of EdgeArray. Default Integrals.
   */
  vtkSetMacro(EdgeValues, int);
  vtkGetMacro(EdgeValues, int);
  ///@}

  enum CoordinateKinds
  {
    /** The points are places in space. */
    Space = 0,
    /** The surface is a flat map: x is the longitude and y the latitude, in degrees. The flow is decomposed on the unit sphere. */
    LongitudeAndLatitude = 1
  };

  ///@{
  /**
   * The meaning of the coordinates of the points: places in space, or longitude and latitude of a flat map in degrees. On a map, vectors
   * in and out are (eastward, northward, upward), and Axis does not count. Default Space.
   */
  vtkSetMacro(Coordinates, int);
  vtkGetMacro(Coordinates, int);
  ///@}

  enum BoundaryKinds
  {
    /** Coasts: nothing flows through. The stream function is constant on each, and zero on the longest of a component. */
    Closed = 0,
    /** The edge of a region: the potential is zero there. */
    Open = 1
  };

  ///@{
  /**
   * The meaning of the surface's boundary for the flow. Default Closed. Where an array of 1 component is chosen with index 3 of
   * SetInputArrayToProcess, the boundary is open along the cells, or between two points, for which it is neither 0 nor NaN, and closed
   * elsewhere. Of a boundary that is partly open, each arc then counts as a boundary in the outputs.
   */
  vtkSetMacro(Boundary, int);
  vtkGetMacro(Boundary, int);
  ///@}

  ///@{
  /**
   * Whether GradientPart and Potential are computed. Default on.
   */
  vtkSetMacro(GradientPart, bool);
  vtkGetMacro(GradientPart, bool);
  vtkBooleanMacro(GradientPart, bool);
  ///@}

  ///@{
  /**
   * Whether RotationalPart, StreamFunction and its contours are computed. Default on.
   */
  vtkSetMacro(RotationalPart, bool);
  vtkGetMacro(RotationalPart, bool);
  vtkBooleanMacro(RotationalPart, bool);
  ///@}

  ///@{
  /**
   * Whether HarmonicPart is computed. Default on.
   */
  vtkSetMacro(HarmonicPart, bool);
  vtkGetMacro(HarmonicPart, bool);
  vtkBooleanMacro(HarmonicPart, bool);
  ///@}

  ///@{
  /**
   * Whether SteeringFlow is computed: the flow without the gradient of a potential and the turned gradient of a stream function that are
   * zero on all of the boundary. It has neither divergence nor vorticity inside, as the wind that a storm stands in, whatever Boundary is. It
   * holds the residual, and is no addend of its own. It takes two solves more. Default off.
   */
  vtkSetMacro(SteeringFlow, bool);
  vtkGetMacro(SteeringFlow, bool);
  vtkBooleanMacro(SteeringFlow, bool);
  ///@}

  ///@{
  /**
   * Whether Divergence and Vorticity are computed, which takes no solve: those of the linear flow nearest to the data around a point. Default
   * on.
   */
  vtkSetMacro(Derivatives, bool);
  vtkGetMacro(Derivatives, bool);
  vtkBooleanMacro(Derivatives, bool);
  ///@}

  ///@{
  /**
   * The number of values of the stream function that have lines on port 1. Default 20, range 0 (none) to 1000.
   */
  vtkSetMacro(NumberOfContours, int);
  vtkGetMacro(NumberOfContours, int);
  ///@}

  ///@{
  /**
   * The boundary against which BoundaryTransport of port 2 is measured, by its number there. Default 0: the longest of the first
   * component. A number that no boundary has is an error.
   */
  vtkSetMacro(ReferenceBoundary, int);
  vtkGetMacro(ReferenceBoundary, int);
  ///@}

  ///@{
  /**
   * The distance of the lines of port 1 from the surface along its normal, as a fraction of the surface's size. Default 0, range 0 to 0.1: they
   * lie in the surface, and show from both sides of it where they are drawn nearer to the viewer, as ParaView does in the representation
   * Ink; for other programs, see vtkFieldDrawingAlgorithm::GetInkShader(). Elsewhere a thousandth shows them from one side.
   */
  vtkSetMacro(Lift, double);
  vtkGetMacro(Lift, double);
  ///@}

  ///@{
  /**
   * The length of the unit of the points: 6371000 for the Earth as a unit sphere and a flow in m/s, so that the stream function is in
   * m^2/s. Default 1, between 1e-30 and 1e30.
   */
  vtkSetMacro(LengthScale, double);
  vtkGetMacro(LengthScale, double);
  ///@}

  ///@{
  /**
   * The direction to the north pole from the origin, for eastward and northward components. Default (0, 0, 1). (0, 0, 0) is an error.
   */
  vtkSetVector3Macro(Axis, double);
  vtkGetVector3Macro(Axis, double);
  ///@}

  enum Solvers
  {
    /** Cholesky up to 100,000 points and where enough solves are expected, else conjugate gradients. */
    Automatic = 0,
    /** Sparse Cholesky factorisation. */
    Cholesky = 1,
    /** Conjugate gradients, preconditioned by multigrid. */
    ConjugateGradients = 2
  };

  ///@{
  /**
   * The method for both functions, one of Solvers. Default Automatic.
   */
  vtkSetMacro(Solver, int);
  vtkGetMacro(Solver, int);
  ///@}

  ///@{
  /**
   * The number of solves to come. Automatic factors larger surfaces, too, where a factor pays: from sqrt(n) / 40 solves on n points, where
   * most computers can hold it. Where the input has time steps, at least two for each of them. Default 1, at least 1.
   */
  vtkSetMacro(ExpectedSolves, int);
  vtkGetMacro(ExpectedSolves, int);
  ///@}

  ///@{
  /**
   * The numbers of times that this object has set up a solver on a surface, found harmonic fields or functions of islands, and solved
   * for a potential or stream function.
   */
  int GetNumberOfSetups() const;
  int GetNumberOfBases() const;
  int GetNumberOfSolves() const;
  ///@}

  vtkHodgeDecomposition(const vtkHodgeDecomposition&) = delete;
  void operator=(const vtkHodgeDecomposition&) = delete;

protected:
  vtkHodgeDecomposition();
  ~vtkHodgeDecomposition() override;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  std::string EdgeArray = "OneForm";
  int EdgeValues = Integrals;
  int Coordinates = Space;
  int Boundary = Closed;
  bool GradientPart = true;
  bool RotationalPart = true;
  bool HarmonicPart = true;
  bool SteeringFlow = false;
  bool Derivatives = true;
  int NumberOfContours = 20;
  int ReferenceBoundary = 0;
  double Lift = 0.0;
  double LengthScale = 1.0;
  double Axis[3] = { 0.0, 0.0, 1.0 };
  int Solver = Automatic;
  int ExpectedSolves = 1;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

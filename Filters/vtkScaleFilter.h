/**
 * @class   vtkScaleFilter
 * @brief   functions and flows on a surface below and above a wavelength, and their spectra
 *
 * A function or a flow is the sum of a part below and a part above a wavelength: the part below is what is larger than that, without the small
 * scales. It solves (M + 2 c^(2 p) (L M^-1)^(p-1) L) x = M f with the Laplacian L, the areas M of the points, c = wavelength / (2 pi), and
 * the order p, 1 or 2. A wave of the wavelength keeps 1/3 of its amplitude, at either order; one of length w keeps
 *
 *   1 / (1 + 2 (wavelength / w)^(2 p)) .
 *
 * Half of the amplitude is kept at 1.41 wavelengths (order 1) or 1.19 (order 2). Means over each component of the surface stay.
 * Filters/Core/Scales/Scales.md has the equations.
 *
 * @section vtkScaleFilter-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it, with any number of arrays to filter, of points or of cells:
 *
 * - those added by AddArray: arrays of numbers are functions; arrays of vectors of 3 numbers, or of 2 in a plane of constant z, are flows,
 *   of which the tangential part counts;
 * - eastward and northward components of a flow, chosen by SetInputArrayToProcess with indices 1 and 2, for surfaces around the origin with
 *   Axis to the north, or for flat maps (Coordinates). Results are called Flow;
 * - without any of these, the active scalars and the active vectors (index 0), of points or else of cells; without these, the only array.
 *
 * An array of numbers with index 3 makes wavelengths vary: at each point they are so many times those asked for, as a local Rossby radius in
 * km, or the size of the cells, filtered at a wavelength of 1 or 3. Numbers are positive; NaN is land. Constants and means stay.
 *
 * A cell with a number of one of them that is NaN, or with such a point, takes no part, as land: its sides are coasts. It is NaN in what
 * comes out. Fill values (1e20, -9999, infinite) far from the others are an error or a warning.
 *
 * @section vtkScaleFilter-Output Output
 *
 * Port 0: of the type of the input, with all its arrays, and for each array NAME and each wavelength L, as double:
 *
 * | array                                        | components | meaning                                                 |
 * | -------------------------------------------- | ---------- | ------------------------------------------------------- |
 * | NAME below L                                 | 1 or 3     | where NAME stands; of the first function the active scalars |
 * | NAME above L                                 | 1 or 3     | the rest: both sum to NAME, or to its tangential part   |
 * | NAME divergent below L, NAME rotational below L | 3       | parts of a flow (SetPartsApart)                         |
 *
 * Functions of cells are filtered at points, by means of the cells around, so that waves of two cells are above.
 *
 * Field data:
 *
 * | array                    | tuples      | meaning                                                          |
 * | ------------------------ | ----------- | ---------------------------------------------------------------- |
 * | Wavelengths              | wavelengths | in the unit of the points times LengthScale                      |
 * | ScaledFunctions          | functions   | their names                                                      |
 * | MeansBefore, MeansAfter  | wavelengths | means over the surface, a component per function                 |
 * | Iterations               | wavelengths | of the solves, a component for each function, and two for each flow |
 * | Converged                | 1           | whether all have                                                 |
 * | CellsWithoutData         | 1           | cells that took no part                                          |
 * | PositiveSide             | 1           | the side by which cells turn; see vtkOrientedSurfaceAlgorithm    |
 *
 * Port 1: vtkTable, the spectrum: a row for each of SpectrumRows wavelengths, evenly spaced in octaves, with the columns Wavelength and Wavenumber
 * (2 pi over it) and, for each quantity NAME,
 *
 * | column               | meaning                                                                                             |
 * | -------------------- | --------------------------------------------------------------------------------------------------- |
 * | NAME per octave      | mean square of the waves of this length, for each factor of 2 in length                             |
 * | NAME per wavenumber  | the same, for a unit of the wavenumber                                                              |
 * | NAME in band         | mean square in the row; shorter waves are in the first, longer ones in the last, so that rows sum to the variance |
 * | NAME above           | mean square above the longer end of the row                                                         |
 *
 * A wave is largest per octave at its own length. A flow by its parts has such columns for NAME divergent and NAME rotational, too; what its
 * cells do not resolve is in its first row. Field data of the table: "NAME variance", and "NAME harmonic variance" of the harmonic part, which
 * has no wavelength.
 *
 * @section vtkScaleFilter-Execution Execution
 *
 * A solve for each function and wavelength, and two for each flow, which needs a Hodge decomposition as well. The set-up of the surface serves all
 * arrays, wavelengths and times. The spectrum has SpectrumRows + 1 wavelengths more. Where no array is chosen, the first output is the input,
 * beside the error, so that a window goes on to show the surface.
 *
 * On several ranks, with the option DMG_PETSC, functions and flows as wholes (FlowKind) of points stay in pieces: each rank has the results of its
 * own points, and the first one the spectrum. Gathered on the first rank are flows by their parts, arrays of cells, eastward and northward
 * components, flat maps, wavelengths that vary, values that are NaN or may be fill values, and all where Solver is Cholesky.
 *
 * @sa vtkHodgeDecomposition
 */

#ifndef vtkScaleFilter_h
#define vtkScaleFilter_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

#include <memory> // For std::unique_ptr

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkScaleFilter : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkScaleFilter* New();
  vtkTypeMacro(vtkScaleFilter, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The names of the arrays to filter, each of points or else of cells. Default none: see Inputs. Adding a name again changes nothing.
   */
  void AddArray(const char* name);
  void ClearArrays();
  int GetNumberOfArrays() const;
  const char* GetArray(int index) const;
  ///@}

  ///@{
  /**
   * The wavelengths to filter at, in the unit of the points times LengthScale. Default none, which stands for one of ten mean edges, rounded
   * to two digits, or for 1 where wavelengths vary. One that is not positive is an error; one below four mean edges or beyond the surface a warning, with the amplitude that
   * such waves keep. Adding one again changes nothing.
   */
  void AddWavelength(double wavelength);
  void ClearWavelengths();
  int GetNumberOfWavelengths() const;
  double GetWavelength(int index) const;
  ///@}

  ///@{
  /**
   * The order of the filter, 1 or 2. Order 2 separates scales more sharply. Default 2.
   */
  vtkSetMacro(Order, int);
  vtkGetMacro(Order, int);
  ///@}

  enum FlowKinds
  {
    /**
     * Potential and stream function are filtered, after a Hodge decomposition: nothing flows through coasts, transports between them and
     * the harmonic part stay, and no divergence comes where there was none. Wavenumbers are those of these functions.
     */
    Parts = 0,
    /**
     * Vectors are compared by parallel transport. They may cross coasts, and wavenumbers have a term of the curvature: on a sphere of radius
     * R, k^2 is less by 1 / R^2.
     */
    Wholes = 1
  };

  ///@{
  /**
   * How flows are filtered. Default Parts.
   */
  vtkSetMacro(FlowKind, int);
  vtkGetMacro(FlowKind, int);
  ///@}

  ///@{
  /**
   * Whether the divergent and the rotational part of flows below each wavelength are written apart, where FlowKind is Parts. Default off.
   */
  vtkSetMacro(PartsApart, bool);
  vtkGetMacro(PartsApart, bool);
  vtkBooleanMacro(PartsApart, bool);
  ///@}

  enum BoundaryKinds
  {
    /** Coasts: nothing flows through. */
    Closed = 0,
    /** The edge of a region: the potential is zero there. */
    Open = 1
  };

  ///@{
  /**
   * The meaning of the surface's boundary for flows, where FlowKind is Parts. Default Closed. Functions have no slope across a boundary.
   */
  vtkSetMacro(Boundary, int);
  vtkGetMacro(Boundary, int);
  ///@}

  enum CoordinateKinds
  {
    /** The points are places in space. */
    Space = 0,
    /** The surface is a flat map: x is the longitude and y the latitude, in degrees. All is filtered on the unit sphere. */
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

  ///@{
  /**
   * The length of the unit of the points: 6371 for the Earth as a unit sphere and wavelengths in km. Default 1, between 1e-30 and 1e30.
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

  ///@{
  /**
   * Whether the spectrum of port 1 is computed. Default on.
   */
  vtkSetMacro(Spectrum, bool);
  vtkGetMacro(Spectrum, bool);
  vtkBooleanMacro(Spectrum, bool);
  ///@}

  ///@{
  /**
   * The shortest and the longest wavelength of the spectrum, in the unit of the points times LengthScale. Default 0, which stands for four mean
   * edges and for twice the root of the area. Range 0 to infinity.
   */
  vtkSetMacro(SpectrumFrom, double);
  vtkGetMacro(SpectrumFrom, double);
  vtkSetMacro(SpectrumTo, double);
  vtkGetMacro(SpectrumTo, double);
  ///@}

  ///@{
  /**
   * The number of rows of the spectrum. Default 24, range 1 to 1000.
   */
  vtkSetMacro(SpectrumRows, int);
  vtkGetMacro(SpectrumRows, int);
  ///@}

  ///@{
  /**
   * The relative error to which a part is solved for, the smaller one of both. Default 1e-6, range 1e-14 to 0.1.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  enum Solvers
  {
    /** Cholesky up to 100,000 points, else conjugate gradients. */
    Automatic = 0,
    /** Sparse Cholesky factorisation, of each wavelength anew. */
    Cholesky = 1,
    /** Conjugate gradients, preconditioned by multigrid. */
    ConjugateGradients = 2
  };

  ///@{
  /**
   * The method for all equations, one of Solvers. Default Automatic.
   */
  vtkSetMacro(Solver, int);
  vtkGetMacro(Solver, int);
  ///@}

  ///@{
  /**
   * The numbers of times that this object has set up a solver on a surface, and split a quantity at a wavelength, those of spectra included.
   */
  int GetNumberOfSetups() const;
  int GetNumberOfSplits() const;
  ///@}

  vtkScaleFilter(const vtkScaleFilter&) = delete;
  void operator=(const vtkScaleFilter&) = delete;

protected:
  vtkScaleFilter();
  ~vtkScaleFilter() override;

  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  int Order = 2;
  int FlowKind = Parts;
  bool PartsApart = false;
  int Boundary = Closed;
  int Coordinates = Space;
  double LengthScale = 1.0;
  double Axis[3] = { 0.0, 0.0, 1.0 };
  bool Spectrum = true;
  double SpectrumFrom = 0.0;
  double SpectrumTo = 0.0;
  int SpectrumRows = 24;
  double Tolerance = 1e-6;
  int Solver = Automatic;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

/**
 * @class   vtkHarmonicFieldSolver
 * @brief   computes the smoothest field on a surface that follows prescribed directions
 *
 * A field of N directions has N tangent vectors at each point, 2 pi / N apart: vectors (N = 1), lines (2), crosses (4), hexagonal
 * fields (6). This filter represents it by unknowns X, one of Discretisations, and minimises
 *
 *   smoothness energy(X) + Alignment * sum over prescribed elements b of w_b m_b |X_b - Y_b|^2.
 *
 * Y_b is what is prescribed, w_b its weight, and m_b the size of the element relative to the mean. Hard constraints hold
 * X_b = Y_b exactly instead. A component of the surface where nothing is prescribed gets the smoothest field of mean square
 * magnitude 1 (Knoeppel et al. 2013): the eigenvector of the lowest eigenvalue. A function is zero there.
 *
 * Filters/HarmonicFieldSolver.md has details, the pages in Filters/Core/Discretisations formulas. The method is that of Tom Broeders,
 * "Simplification Directional Fields", sections 6.1 to 6.3.
 *
 * @section vtkHarmonicFieldSolver-Inputs Inputs
 *
 * Port 0, the surface: see vtkOrientedSurfaceAlgorithm. CoarseSpace StructurePreserving, NestedIterations and CoarseProlongation
 * use the operators that vtkDirectionalProlongation has stored with it. Those of other points and triangles are an error.
 *
 * Port 1, guides (optional, any number of connections; ports 3, 4 and 5 take one more each): vtkDataSet, or composite
 * datasets of these. Each goes to the nearest place. Chosen vectors prescribe the
 * nearest face. Without a choice, lines prescribe their tangents on all faces that they pass; without lines, the active
 * vectors count. A guide with neither is an error. A warning counts what is left out: what lies farther than MaximumDistance, on
 * the far side of a thin wall, or within 5 degrees of the normal.
 *
 * Port 2, singularities (optional, of the same types): points around which the field rotates by a multiple of 2 pi / N. A power
 * field gets these and no others, and rotates as little as it can (trivial connections, Crane et al. 2010). Indices are
 * multiples of 1 / N. On a closed component they sum to the Euler characteristic, 2 - 2 genus. Constraints rotate the field as a whole.
 * Outputs 0 and 3 of vtkFieldSingularities fit. PointPowerField gives the field of PowerField then.
 *
 * SetInputArrayToProcess(index, 0, 0, association, name) chooses arrays of the surface, and
 * SetGuideArrayToProcess(index, 1, 0, association, name) those of guides:
 *
 * | index | components | meaning                                                        |
 * | ----- | ---------- | -------------------------------------------------------------- |
 * | 0     | 1          | mask: not zero where prescribed                                |
 * | 1     | 3          | directions                                                     |
 * | 2     | 1          | weight, by default 1; 0 where nothing is prescribed            |
 * | 3     | 1          | values of functions, at points; not of guides                  |
 * | 4     | 1          | rotation in degrees; not of guides                             |
 * | 5, 6  | 1          | eastward, northward component around Axis, instead of 1; not of guides |
 * | 7     | 1          | source f of functions: -Laplace u = f                          |
 *
 * All are optional, on points or cells. Without a mask, a direction is prescribed wherever its vector is not zero. Its
 * tangential part counts, and its length is the magnitude. Nothing is followed that was not chosen. "Active Vectors" are those
 * of the points, else of the cells, but for Direction0.
 *
 * Directions of the surface may be tensors of 6 (XX YY ZZ XY YZ XZ) or 9 components (their symmetric parts), for power fields of an even N,
 * or vectors of 2 components in a plane of constant z. What is not finite, zero in the mask or perpendicular to the surface is left
 * out, and a warning counts it.
 *
 * The field also follows features of the surface whose weight is not 0: BoundaryWeight, SharpEdgesWeight, CurvatureWeight.
 *
 * @section vtkHarmonicFieldSolver-Outputs Outputs
 *
 * Port 0, the surface: of the type of the input, with all its cells, points and arrays (strips come out as triangles), and
 *
 * | array                     | of            | components | meaning                                                   |
 * | ------------------------- | ------------- | ---------- | --------------------------------------------------------- |
 * | Direction0                | cells, points | 3          | first direction; active vectors                           |
 * | Direction1, ... N - 1     | cells, points | 3          | others, with AllDirections                                |
 * | PowerField                | cells, points | 2          | the N-th power, a complex number (power fields only)      |
 * | FaceField                 | cells         | 3          | X in space (face fields only)                             |
 * | ScalarFunction            | points        | 1          | X (functions only)                                        |
 * | Prescribed                | cells, points | 1          | weight, else 0, where unknowns are (1-forms: port 1)      |
 * | PrincipalValues           | cells, points | 2          | of tensors: along the direction (the larger), across     |
 * | SingularityIndex          | cells, points | 1          | multiple of 1 / N (cells: PointPowerField, not prescribed) |
 * | HarmonicBasis 1, 2, ... k | cells         | 3          | fields without divergence and curl, with HarmonicBasis    |
 *
 * Port 1, the edges: vtkPolyData, a line per edge from the smaller to the larger point index, with the cell array Rotation,
 * the rotation of the field from the face on the left to the face on the right, in radians; for PointPowerField, that along the edge.
 * 1-forms add the cell arrays OneForm, integrals along edges, and HarmonicBasis 1, 2, ... k.
 *
 * Port 2, the convergence: vtkTable, a row per iteration, the first for the start. The page has its columns, and the report that
 * ports 0 and 2 carry as field data.
 *
 * Port 3, the paths of guides: vtkPolyData, lines on the surface where guides were taken.
 *
 * @section vtkHarmonicFieldSolver-Execution Execution
 *
 * Set-up (surface, levels, Discretisation, N), system (which elements are prescribed, weights, options) and solve (values, Tolerance)
 * are stages, which keep their results until their causes change, for each leaf of a composite dataset. A solve starts from the
 * solution before. One that misses Tolerance gives its best field, Converged = 0 and a warning. Harmonic parts of face fields and
 * 1-forms that the constraints do not determine are left out, with a warning. An error or an aborted run keeps complete stages.
 * Filters/Core/Pieces/Pieces.md says which surfaces in pieces are solved in pieces. OPENBLAS_NUM_THREADS fixes the bits of BLAS.
 *
 * @sa vtkDirectionalField vtkDirectionalProlongation vtkPrincipalDirections
 */

#ifndef vtkHarmonicFieldSolver_h
#define vtkHarmonicFieldSolver_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkOrientedSurfaceAlgorithm.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkHarmonicFieldSolver : public vtkOrientedSurfaceAlgorithm
{
public:
  static vtkHarmonicFieldSolver* New();
  vtkTypeMacro(vtkHarmonicFieldSolver, vtkOrientedSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Discretisations
  {
    /**
     * The N-th power of the directions per face, as a complex number, with the Dirichlet energy; for triangles that are about
     * equilateral. On sheared ones, as grids have, it is wrong.
     */
    PowerField = 0,
    /** A vector per face; N is 1. The energy is its squared divergence and curl. For flows. */
    FaceField = 1,
    /**
     * A number per edge, the integral of a 1-form along it, with the energy of FaceField; N is 1. For circulations and for what is
     * integrated along paths.
     */
    OneForm = 2,
    /** A number per point, with the Dirichlet energy; N is 1. For potentials, whose gradient is shown. */
    ScalarFunction = 3,
    /**
     * The N-th power of the directions per point, as a complex number, with the Dirichlet energy; for any triangles. For crosses and
     * lines, and wherever the direction matters more than the length, which fades away from the constraints. Singularities stand on
     * triangles.
     */
    PointPowerField = 4
  };

  ///@{
  /**
   * The meaning of the unknowns, one of Discretisations. Default PointPowerField.
   */
  vtkSetMacro(Discretisation, int);
  vtkGetMacro(Discretisation, int);
  ///@}

  ///@{
  /**
   * N, the number of directions per point of power fields. Default 4, range 1 to 8.
   */
  vtkSetMacro(NumberOfDirections, int);
  vtkGetMacro(NumberOfDirections, int);
  ///@}

  enum NetSources
  {
    /** An error that names the integral. */
    Refuse = 0,
    /** The mean of the source is subtracted. */
    TakeOut = 1
  };

  ///@{
  /**
   * The treatment of a source that does not integrate to zero over a component without prescribed values, where nothing leaves.
   * The function has a mean of zero there. Default Refuse.
   */
  vtkSetMacro(NetSource, int);
  vtkGetMacro(NetSource, int);
  ///@}

  enum ConstraintTypes
  {
    /** Prescribed directions pull with a weight; they may disagree. */
    Soft = 0,
    /** Prescribed directions hold exactly. */
    Hard = 1
  };

  ///@{
  /**
   * The kind of all constraints, one of ConstraintTypes. Default Soft.
   */
  vtkSetMacro(ConstraintType, int);
  vtkGetMacro(ConstraintType, int);
  ///@}

  ///@{
  /**
   * Weight of soft constraints; without effect on hard ones. At 1, a prescribed face of mean area counts as much as
   * a difference across one of its edges of weight 1; on equilateral triangles edges have 3.46. Default 1; a value
   * that is not positive is an error.
   */
  vtkSetMacro(Alignment, double);
  vtkGetMacro(Alignment, double);
  ///@}

  ///@{
  /**
   * The length over which directions of the surface are smoothed, relative to the diagonal of its bounding box: for arrays that hold
   * directions nearly everywhere, as measured ones do. Details smaller than that fade, whatever the resolution: a wave of length l
   * keeps 1 / (1 + (2 pi SmoothingLength / l)^2) of its amplitude. It takes the place of Alignment, and has no effect on guides,
   * features and hard constraints. Default 0, off; range 0 to 1.
   *
   * The smoothed field does not change across a boundary. At the rim of a solid rotation it is off by the change of the speed over one such
   * length, at three lengths from the rim by 5 % of that; and it crosses coasts. Leave out a band of three lengths (vtkClipPolyData). A flow
   * that may not cross coasts is smoothed by vtkScaleFilter, by its parts.
   */
  vtkSetMacro(SmoothingLength, double);
  vtkGetMacro(SmoothingLength, double);
  ///@}

  ///@{
  /**
   * Whether the field is the smoothest one nearby among those of unit length, in place of the smoothest one of any length. A field of
   * any length is short far from what it follows, and its singularities meet there; at unit length they keep apart, as quads want them.
   * Prescribed vectors count by their directions alone. Singularities move until the energy stands still, which costs some seventy
   * solves of well-conditioned systems on the same set-up. Of power fields and face fields without prescribed singularities, without
   * effect on others. Default off.
   */
  vtkSetMacro(UnitLengthWhileSmoothing, bool);
  vtkGetMacro(UnitLengthWhileSmoothing, bool);
  vtkBooleanMacro(UnitLengthWhileSmoothing, bool);
  ///@}

  ///@{
  /**
   * Whether the difference of both principal values in the tangent plane, relative to its mean, weighs the directions of tensors:
   * less where a tensor has no clear direction. Default off.
   */
  vtkSetMacro(TensorWeights, bool);
  vtkGetMacro(TensorWeights, bool);
  vtkBooleanMacro(TensorWeights, bool);
  ///@}

  ///@{
  /**
   * The direction to the north pole from the origin, for eastward and northward components; any vector but (0, 0, 0). Default
   * (0, 0, 1).
   */
  vtkSetVector3Macro(Axis, double);
  vtkGetVector3Macro(Axis, double);
  ///@}

  enum Solvers
  {
    /**
     * Cholesky for small systems, for many solves (ExpectedSolves), where more than 3 % of the triangles are thin, and, for
     * face fields and 1-forms, where more than 40 homology generators (two per handle, one per hole) carry harmonic fields; else
     * conjugate gradients.
     */
    Automatic = 0,
    /** Sparse Cholesky factorisation. */
    Cholesky = 1,
    /** Multigrid V-cycles alone. */
    VCycles = 2,
    /**
     * Conjugate gradients, preconditioned by one V-cycle. Where these stagnate, or do not converge in 100 iterations
     * (MaximumNumberOfIterations allowing), a factor of the system takes over from where they are, with a warning; but not where
     * rounding errors are all that is left.
     */
    ConjugateGradients = 3,
    /**
     * Full multigrid: solved on the coarsest level, carried up level by level and smoothed on each. An approximation for the
     * price of a few cycles, with errors of 0.1 to 20 %.
     */
    NestedIterations = 4,
    /** Solved on the coarsest level and carried to the surface: a sketch, with errors of 25 to 90 %. */
    CoarseProlongation = 5
  };

  ///@{
  /**
   * The method, one of Solvers; a surface without coarse levels is factored by all of them. Default
   * Automatic.
   */
  vtkSetMacro(Solver, int);
  vtkGetMacro(Solver, int);
  ///@}

  ///@{
  /**
   * The number of solves with the same prescribed places and weights that are to come, as for a time series of measured
   * directions. Automatic factors the system where a factor would pay: from 0.06 sqrt(n) solves of n unknowns on (power
   * fields and 1-forms; 0.5 sqrt(n) of face fields), and where most computers can hold it. Default 1, at least 1.
   */
  vtkSetMacro(ExpectedSolves, int);
  vtkGetMacro(ExpectedSolves, int);
  ///@}

  enum CoarseSpaces
  {
    /** Vectors, or values of functions, at samples of the surface or at vertices of the coarse levels; the fast one. */
    LinearInterpolation = 0,
    /** Powers, face fields, 1-forms or functions as on the surface, as in the thesis. */
    StructurePreserving = 1
  };

  ///@{
  /**
   * The unknowns of the coarse levels of multigrid, one of CoarseSpaces; without effect on Cholesky.
   * StructurePreserving takes operators of the discretisation (vtkDirectionalProlongation:
   * PowerFields, FaceFields, OneForms) and more iterations. Default LinearInterpolation.
   */
  vtkSetMacro(CoarseSpace, int);
  vtkGetMacro(CoarseSpace, int);
  ///@}

  ///@{
  /**
   * The solve stops at this RelativeResidual, an estimate of the relative error in the energy norm. At the default, directions are within
   * 1 degree where the length of the field is at least a hundredth of its root mean square, which neither a picture nor a remesher shows.
   * Far from the constraints the field fades, the more the higher N is, and its directions are off by more. Choose 1e-8 there, and for
   * computations that go on with the numbers. The smoothest field, where nothing is prescribed, is solved to a hundredth of it, 1e-8 at
   * least. Default 1e-4, range 1e-14 to 1.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The solve stops after this many iterations, that for the smoothest field, where nothing is prescribed, after three times as
   * many, with a warning. Default 100, at least 1.
   */
  vtkSetMacro(MaximumNumberOfIterations, int);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Whether the direction arrays hold unit vectors (zero where the field vanishes) or vectors of
   * length |X|. It changes output arrays only. Default on.
   */
  vtkSetMacro(UnitLength, bool);
  vtkGetMacro(UnitLength, bool);
  vtkBooleanMacro(UnitLength, bool);
  ///@}

  ///@{
  /**
   * Whether all N directions come as arrays, Direction0 to Direction(N - 1), rather than Direction0 alone. The others follow from it:
   * Direction k is Direction0, rotated counter-clockwise by 360 k / N degrees, seen from the positive side. The filters and writers of this
   * module know that, by the field data NumberOfDirections. Default off.
   */
  vtkSetMacro(AllDirections, bool);
  vtkGetMacro(AllDirections, bool);
  vtkBooleanMacro(AllDirections, bool);
  ///@}

  ///@{
  /**
   * Whether Direction0 is chosen to continue from face to face wherever possible (combing), or is
   * the principal root in each frame. On, Direction0 jumps only along cuts, which streamlines and
   * line integral convolution need; off saves a little time. While guides move, Direction0 of a cell goes on as
   * the direction that is nearest to the one before, unless half of the field turns by more than 90 / N degrees
   * at once; then, and after Combing was off, it is combed anew. Default on.
   */
  vtkSetMacro(Combing, bool);
  vtkGetMacro(Combing, bool);
  vtkBooleanMacro(Combing, bool);
  ///@}

  ///@{
  /**
   * Whether the harmonic fields of the surface, those without divergence and curl, come along as
   * arrays: orthonormal in the integral over the surface, 2 g for a closed component of genus g,
   * 2 g + b - 1 for one with b > 0 boundary loops, none of them across the boundary. Of face fields
   * and 1-forms; without effect on power fields and functions. They take a factorisation of the vertices, once
   * per surface and discretisation. Where loops times faces are more than 5e7, a warning and no
   * arrays. Default off.
   */
  vtkSetMacro(HarmonicBasis, bool);
  vtkGetMacro(HarmonicBasis, bool);
  vtkBooleanMacro(HarmonicBasis, bool);
  ///@}

  ///@{
  /**
   * Whether the field follows the chosen directions of the surface, with their mask and weights. Default on.
   */
  vtkSetMacro(FollowDirections, bool);
  vtkGetMacro(FollowDirections, bool);
  vtkBooleanMacro(FollowDirections, bool);
  ///@}

  ///@{
  /**
   * The guides, input port 1. AddInputConnection(1, output) and AddInputDataObject(1, data) add one, too. An output that is
   * connected twice, also to ports 3, 4 or 5, is followed once, with a warning.
   */
  void AddGuidesConnection(vtkAlgorithmOutput* output);
  void RemoveAllGuides();
  ///@}

  ///@{
  /**
   * Disconnects input port 3, 4 or 5.
   */
  void RemoveSecondGuide();
  void RemoveThirdGuide();
  void RemoveFourthGuide();
  ///@}

  /**
   * The things that the field of the last update follows, in words, like "array 'Wind', 2 guides, boundary"; "nothing" for the
   * smoothest one. Empty before.
   */
  const char* GetFollowed() const;

  /**
   * Chooses an array of the guides: index 0 mask, 1 directions, 2 weights; port 1; connection 0, whatever the number of guides; an
   * association of vtkDataObject; a name, of which an empty one or null chooses nothing, the default. (ParaView 5.11 ends where
   * SetInputArrayToProcess has no index 0 of a connection.)
   */
  void SetGuideArrayToProcess(int index, int port, int connection, int association, const char* name);

  ///@{
  /**
   * Chooses arrays of the guides by name alone: directions at points, else on cells; weights at points, else on cells, else in field
   * data. Weights may be numbers, too: one for all guides, as in "5", or one for each in the order of ports and connections, as
   * in "1 0.5". A port without a connection has a number, too, so that guides after it keep theirs. The number 0 leaves a guide out,
   * and guides without a number have 1. More numbers are a warning. Default empty.
   */
  void SetGuideDirections(const char* name);
  const char* GetGuideDirections() const;
  void SetGuideWeights(const char* name);
  const char* GetGuideWeights() const;
  ///@}

  ///@{
  /**
   * The singularities, input port 2, added and removed as guides are; and the name of the point array that holds
   * their indices. Default empty: "Index" where there is such an array, else 1 / N each.
   */
  void AddSingularitiesConnection(vtkAlgorithmOutput* output);
  void RemoveAllSingularities();
  vtkSetStdStringFromCharMacro(SingularityIndexArray);
  vtkGetCharFromStdStringMacro(SingularityIndexArray);
  ///@}

  ///@{
  /**
   * The largest distance of guides and singularities from the surface, relative to the diagonal of its bounding box. Default
   * 0.1, at least 0.
   */
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  ///@{
  /**
   * The weights by which the field follows the boundary of the surface, counter-clockwise around it, and its sharp edges, which have
   * no sign, so that N is even. These weights, and those of lines among the guides, are relative to the surface's size, and mean the
   * same at any resolution. At weight 1 the field follows what is larger than about a thirtieth of the size; for twice the detail, the
   * weight is 4. Default 0, off; a weight is 0 or from 1e-10 to 1e10, or it is an error.
   */
  vtkSetMacro(BoundaryWeight, double);
  vtkGetMacro(BoundaryWeight, double);
  vtkSetMacro(SharpEdgesWeight, double);
  vtkGetMacro(SharpEdgesWeight, double);
  ///@}

  ///@{
  /**
   * Edges are sharp where the normals of their two faces differ by more than this, in degrees. Default 30, range 0 to
   * 180.
   */
  vtkSetMacro(FeatureAngle, double);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * The weight by which the field follows principal directions, times their confidence (vtkPrincipalDirections); N is even. It is
   * relative to the surface's size, as BoundaryWeight is. Default 0, off; a weight is 0 or from 1e-10 to 1e10, or it is an error.
   */
  vtkSetMacro(CurvatureWeight, double);
  vtkGetMacro(CurvatureWeight, double);
  ///@}

  ///@{
  /**
   * The rotation of the field against each of these features, in degrees, counter-clockwise seen from the positive side, besides
   * Rotation: for lines across an edge, 90. Default 0, range -180 to 180.
   */
  vtkSetMacro(BoundaryRotation, double);
  vtkGetMacro(BoundaryRotation, double);
  vtkSetMacro(SharpEdgesRotation, double);
  vtkGetMacro(SharpEdgesRotation, double);
  vtkSetMacro(CurvatureRotation, double);
  vtkGetMacro(CurvatureRotation, double);
  ///@}

  enum CurvatureDirections
  {
    /** The direction along which the surface bends most: around a cylinder, across a ridge, and along a groove. */
    MaximumCurvature = 0,
    /** The direction along which the surface bends least: along a cylinder and a ridge, and across a groove. */
    MinimumCurvature = 1
  };

  ///@{
  /**
   * The principal direction that lines and hexagonal fields (N = 2 and 6) follow, one of CurvatureDirections; N = 4
   * and 8 follow both. Default MaximumCurvature.
   */
  vtkSetMacro(CurvatureDirection, int);
  vtkGetMacro(CurvatureDirection, int);
  ///@}

  ///@{
  /**
   * The radius of the region of a principal direction, in units of the mean edge (vtkPrincipalDirections::Scale). Default 3, range 0 to 100.
   */
  vtkSetMacro(CurvatureScale, double);
  vtkGetMacro(CurvatureScale, double);
  ///@}

  ///@{
  /**
   * The rotation of the field against all that it follows, in degrees, counter-clockwise seen from the positive side; the
   * rotations of features come on top. Default 0, range -180 to 180.
   */
  vtkSetMacro(Rotation, double);
  vtkGetMacro(Rotation, double);
  ///@}

  /**
   * Whether features that have a weight are a warning where the surface does not have them, or the field cannot follow them. They are;
   * vtkDirectionalField follows those that there are.
   */
  virtual bool GetWarnsOfMissingFeatures() const { return true; }

  ///@{
  /**
   * The number of times that this object has completed each stage, by which one sees what an update reused.
   */
  int GetNumberOfSetups() const;
  int GetNumberOfSystems() const;
  int GetNumberOfSolves() const;
  ///@}

  vtkHarmonicFieldSolver(const vtkHarmonicFieldSolver&) = delete;
  void operator=(const vtkHarmonicFieldSolver&) = delete;

protected:
  vtkHarmonicFieldSolver();
  ~vtkHarmonicFieldSolver() override;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  // The constructor sets the defaults of the core (dmg::FieldProblem).
  int Discretisation = 0;
  int NumberOfDirections = 0;
  int ConstraintType = 0;
  double Alignment = 0.0;
  double SmoothingLength = 0.0;
  bool TensorWeights = false;
  double Axis[3] = { 0.0, 0.0, 1.0 };
  bool FollowDirections = true;
  double MaximumDistance = 0.0;
  double BoundaryWeight = 0.0;
  double BoundaryRotation = 0.0;
  double SharpEdgesWeight = 0.0;
  double SharpEdgesRotation = 0.0;
  double FeatureAngle = 0.0;
  double CurvatureWeight = 0.0;
  double CurvatureRotation = 0.0;
  int CurvatureDirection = 0;
  double CurvatureScale = 0.0;
  double Rotation = 0.0;
  std::string SingularityIndexArray;
  int NetSource = Refuse;
  int Solver = 0;
  int ExpectedSolves = 0;
  int CoarseSpace = 0;
  double Tolerance = 0.0;
  int MaximumNumberOfIterations = 0;
  bool UnitLength = false;
  bool AllDirections = false;
  bool UnitLengthWhileSmoothing = false;
  bool Combing = false;
  bool HarmonicBasis = false;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

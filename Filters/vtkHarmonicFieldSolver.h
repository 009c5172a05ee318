/**
 * @class   vtkHarmonicFieldSolver
 * @brief   computes the smoothest field on a surface that follows prescribed directions
 *
 * A field of N directions (N = 1: vectors, 2: lines, 4: crosses, 6: hexagonal) has N tangent
 * vectors per point, 2 pi / N apart. vtkHarmonicFieldSolver represents it as Discretisation says,
 * by unknowns X, and finds those that minimise
 *
 *   roughness(X) + Alignment * sum over prescribed elements of w_b m_b |X_b - Y_b|^2,
 *
 * or, with hard constraints, the roughness subject to X_b = Y_b. w_b are the weights that are given; m_b is
 * A_b / (mean A) of a face or of a point, A its area, and, of an edge, its positive mass 2 A_e / |e|^2 (A_e a third of
 * the faces at it, at most 1e4) over 2 (mean A of the faces).
 *
 * - PowerField (default): X is the N-th power of any of the directions, one complex number per face
 *   in a tangent frame of the face. Its roughness is the sum over the edges e of
 *   3 |e|^2 / (A_f + A_g) |difference of X across the edge|^2, A_f and A_g the areas of its two faces (together at least
 *   1e-6 |e|^2). On equilateral triangles that is twice the consistent two-point flux. It is right where triangles are even,
 *   and in the mean where they are random, as in scans; on regular grids, split quads and CAD meshes it is not, at any
 *   resolution (PowerField.md): take PointPowerField there. The magnitude of X fades
 *   away from the constraints and vanishes at singularities. For crosses and lines, and wherever the direction matters
 *   more than the length.
 * - FaceField: X is a vector per face, two components in the face's frame. Its roughness is its
 *   squared divergence and curl, integrated; faces count there with at least 1e-6 times the square of their longest
 *   side for an area. For flows: harmonic where nothing is prescribed.
 * - OneForm: X is a number per edge, the integral of a 1-form along it. Its roughness is h^T L1 h,
 *   the Hodge Laplacian: squared divergence and curl again, with areas of at least 1e-4 times the square of the longest
 *   side, as in functions. For what is integrated along paths;
 *   tangentially continuous. A direction prescribed on a face prescribes the integrals along its
 *   three sides, each with the mean weight of its two faces. One at a point prescribes those along
 *   the edges there, each with the mean weight of its two ends: where both are prescribed by the
 *   trapezoidal rule, else as if the direction were constant along the edge.
 * - ScalarFunction: X is a number per point, the value of a function that is linear on triangles. Its
 *   roughness is its Dirichlet energy, with the cotangent Laplacian; m_b is the area of the point over the
 *   mean one. What is shown is its gradient. For potentials and harmonic functions. Values are prescribed at
 *   points: where the mask is not zero, or, without a mask, where they are not NaN.
 *
 * Where nothing is prescribed, on the whole surface or on one of its components, the field is the smoothest one: of
 * least roughness among those of mean square magnitude 1 (Knoeppel et al. 2013, "Globally optimal direction
 * fields"), the eigenvector of the lowest eigenvalue of the roughness in the field's mass. Of face fields and 1-forms it is a
 * harmonic field where the surface has one. Where the eigenvalue is multiple, as on spheres, any of its fields would
 * do as well; which one comes out depends on the numbering of the triangles. Beside components with prescriptions, its
 * magnitude is of the order of the largest prescribed value. A function is zero there.
 *
 * - PointPowerField: X is the N-th power of any of the directions, one complex number per point in its tangent
 *   plane, linear between points. Its roughness is its Dirichlet energy by the connection Laplacian of Knoeppel et al. 2013;
 *   m_b is the area of the point over the mean one. It is consistent on any triangles, and has half the unknowns. A direction
 *   on a cell counts at its three points, by area. Alignment and the weights of features mean the same as for PowerField.
 *   Singularities stand on triangles. With prescribed singularities the field is that of PowerField.
 *
 * N is 1 for FaceField, OneForm and ScalarFunction. See Tom Broeders, "Simplification Directional Fields", sections 6.1 to
 * 6.3.
 *
 * @section vtkHarmonicFieldSolver-Inputs Inputs
 *
 * Port 0, the surface: vtkPolyData, an oriented manifold triangle surface as described in
 * vtkDirectionalProlongation. On nodal levels conjugate gradients and V-cycles take samples of the surface: one of nine
 * faces for power fields, one of thirty for face fields and 1-forms. Structure-preserving coarse spaces, NestedIterations,
 * CoarseProlongation and a StartingLevel take the operators that vtkDirectionalProlongation has stored with the surface, or
 * else decimate it, in about five times the time of samples, with the default properties of vtkDirectionalProlongation but
 * for what Discretisation asks for. Stored operators of points and triangles that have changed since, or without those of
 * the discretisation, are an error there. No other solver looks at stored operators. All levels that were built for a surface
 * are kept.
 *
 * Port 1, the guides (optional, any number of connections): what the field shall follow, wherever it
 * stands in space. A guide is a vtkDataSet, or a composite dataset, of which all leaves that are
 * vtkDataSet take part. Each is brought to the nearest place of the surface:
 *
 * - points and cells with vectors prescribe the face that is nearest to the point, or to the mean of
 *   the cell's points; a cell that is a line, all faces that the line passes;
 * - where no vectors are chosen, lines (VTK_LINE, VTK_POLY_LINE) prescribe their own tangents, of
 *   length 1, in their direction, on all faces that they pass, however few points they have: polylines
 *   and splines drawn on the surface, streamlines, feature edges;
 * - without lines and without a choice, the active vectors of the points, else of the cells, count.
 *
 * Vectors are no powers: whether a line runs to or fro does not matter to a field of two directions,
 * nor do quarter turns to crosses. On each face, a line weighs as an edge of a feature of that length does (see
 * Features); where it runs along an edge, its two faces share it. So it means the same at any size and resolution: at
 * weight 1 the field follows bends of the line that are larger than a thirtieth of the surface's size. A vector of a point, or of a cell that is no line, weighs as one on the face itself. What several guides
 * prescribe on one face adds up.
 *
 * What is farther from the surface than MaximumDistance is left out, and so is a part of a chord that
 * comes out of the other side of a thin wall: the side that counts is the one that the faces at both
 * ends of the chord show. The part of a line that is within 5 degrees of the normal of the surface is left
 * out as well, and so is such a vector. What was left out is told by a warning and by the report (Outputs). A
 * guide with neither lines nor vectors is an error, an empty one is not.
 *
 * Port 2, the singularities (optional, any number of connections, of the same types as guides): a power field gets
 * these and no others, and turns as little as it can then, by trivial connections (Crane, Desbrun and Schroeder
 * 2010). Each point goes to the nearest point inside the surface. Its index, in the point array that
 * SingularityIndexArray names, is a multiple of 1 / N; those at one point of the surface add up. On a closed component
 * they sum to its Euler characteristic, 2 - 2 genus; else the error says what is missing. With boundary any sum will
 * do: the loops of the boundary take the rest. A dataset without points prescribes that there are none, as a torus or an
 * open surface may have. The field has magnitude 1. Directions, guides and features turn it as a whole, on each component to
 * where the mean of w_b m_b |X_b - Y_b|^2 is least; without any, the first side of one triangle is among its
 * directions. Outputs 0 and 3 of vtkFieldSingularities may be connected here: points with the same PointId, if there is such
 * an array, are one singularity, in their middle. At one point a field can show turns of less than pi / N across each of the
 * edges there; a larger index is a warning.
 *
 * The arrays of the surface are chosen by SetInputArrayToProcess(index, 0, 0, association, name),
 * those of the guides by SetGuideArrayToProcess(index, 1, 0, association, name), where index is:
 *
 * | index | components | meaning                                    |
 * | ----- | ---------- | ------------------------------------------ |
 * | 0     | 1          | mask (optional): not zero where prescribed |
 * | 1     | 3          | directions (optional), by default none; of guides see above |
 * | 2     | 1          | weight (optional), by default 1; 0 where nothing is prescribed |
 * | 3     | 1          | values of functions, at points; not of guides |
 * | 4     | 1          | rotation (optional), in degrees; not of guides |
 *
 * and the association is that of points or cells. The weights of guides may also be in field data
 * (FIELD_ASSOCIATION_NONE), one number for a whole dataset. One choice serves all guides: those
 * without such an array do as if nothing were chosen, and it is an error if none has it. Along a line
 * that is followed itself, mask and weight are those of the cell, or of both ends of a segment.
 *
 * Nothing is followed that was not chosen. The name "Active Vectors" chooses the active vectors of the points, else of the
 * cells, unless they are called Direction0, as those that this filter leaves.
 *
 * Directions of the surface may be symmetric tensors of 6 components (XX YY ZZ XY YZ XZ) or 9: power fields of an even N follow
 * the direction of the largest eigenvalue in the tangent plane, as a unit vector; that of the smallest one is 90 degrees from it
 * (Rotation). Crosses follow both. Where both eigenvalues are equal nothing is prescribed. On a surface in a plane of constant z,
 * vectors may have 2 components.
 *
 * Each array has a tuple for every element; one that has fewer, or other components, is an error.
 * Mask and weights share the association of the directions. An empty name, or "None" where no array has
 * that name, chooses nothing. Without a mask, a direction is prescribed wherever its vector is not
 * zero. Vectors that are not finite, zero in the mask, or perpendicular to the surface are left out, and so are those whose mask
 * or weight is NaN, as where nothing was measured. One warning counts them; where nothing is left there is an error. Hard
 * constraints on every element give that field. Of a vector its tangential part counts: on a face, in the plane of the face; at a point of
 * the surface, in the tangent plane of the point, from where it is carried to the faces around, or,
 * for 1-forms, to the edges there. Each face around a point gets its whole weight: power fields and face fields follow a
 * region that is prescribed at points three times as strongly as one that is prescribed on cells (1-forms equally).
 * Its length is the magnitude that is asked for. Directions on the
 * same face are averaged as powers, values on the same edge as numbers, by weight.
 *
 * Coordinates are at most 1e40, the surface is larger than 1e-40, the longest direction (or largest value) is between
 * 1e-40 and 1e40, and the largest weight, as well as Alignment, between 1e-20 and 1e20; all else is an error, as is a
 * dataset of another type.
 *
 * @section vtkHarmonicFieldSolver-Features Features
 *
 * The field also follows features of the surface itself, each of which has a weight, 0 (off) by default:
 *
 * - BoundaryWeight: the edges of the boundary, counter-clockwise around the surface, which lies on their left. Every N
 *   follows them, and so do face fields and 1-forms; BoundaryRotation 180 turns N = 1 the other way round. With 90, fields end at
 *   the boundary, which face fields and 1-forms resist, as they flow along it by themselves: at weight 1 they were off by 5 to 8 and
 *   20 to 50 degrees (medians on two scans), at weight 100 by less than three.
 * - SharpEdgesWeight: the edges where the normals of both faces differ by more than FeatureAngle.
 * - CurvatureWeight: the principal directions of vtkPrincipalDirections at CurvatureScale, on every face, each weighted
 *   by its confidence. N = 4 and N = 8 follow both directions, N = 2 and N = 6 the one of CurvatureDirection.
 *
 * Sharp edges and principal directions are lines without a sign: fields of an odd N do not follow them, with a warning;
 * neither do face fields and 1-forms, where N is 1. A weight for features that a surface does not have is a warning as
 * well. Functions follow no features.
 *
 * These weights, and those of lines among the guides, are relative to the size L of the surface, the root of its area,
 * and mean the same at any size and resolution: where the roughness is the field's Dirichlet energy and Alignment is 1,
 * they add
 * 30 / L * weight * |X - Y|^2, integrated along lines, on each side, and (30 / L)^2 * weight * confidence * |X - Y|^2,
 * integrated over the surface. So at weight 1 the field follows what is larger than about a thirtieth of the surface's
 * size; for twice as much detail of curvature, the weight is 4. Hard constraints hold boundary and sharp edges exactly,
 * whatever the weight; curvature is soft, and an error with them, except with singularities, where ConstraintType has no
 * effect.
 *
 * All that is followed, arrays of the surface, guides and features, is turned by Rotation and by the array of index 4,
 * counter-clockwise about the normal: fibre and layer angles, helix angles. To that, each feature adds a rotation of its
 * own: BoundaryRotation, SharpEdgesRotation and CurvatureRotation. An array of cells counts at points, and one of
 * points on cells, as the mean of those that they touch.
 *
 * @section vtkHarmonicFieldSolver-Outputs Outputs
 *
 * Port 0, the surface: vtkPolyData, the input with all its arrays, and
 *
 * | array                    | of            | components | meaning                            |
 * | ------------------------ | ------------- | ---------- | ---------------------------------- |
 * | Direction0, 1, ... N - 1 | cells, points | 3          | the directions, counter-clockwise  |
 * | PowerField               | cells, points | 2          | the N-th power, a complex number (power fields only, both kinds) |
 * | FaceField                | cells         | 3          | X in space (face fields only)      |
 * | ScalarFunction           | points        | 1          | X (functions only)                 |
 * | Prescribed               | cells         | 1          | weight, else 0 (1-forms: on port 1, functions and PointPowerField: on points) |
 * | SingularityIndex         | points        | 1          | multiple of 1 / N; 0 on boundaries (PointPowerField: cells) |
 * | HarmonicBasis 1, 2, ... k | cells        | 3          | harmonic fields, with HarmonicBasis |
 *
 * Directions are unit vectors (UnitLength) or have the field's length, in the unit of the
 * prescribed vectors. A 1-form shows the vector of its Whitney interpolant: on a cell that at the
 * centre, at a point the mean over the faces around it. Direction0 becomes the active vector of
 * both. Elements that belong to no triangle hold zeros. The frame of a face has its first axis
 * along the face's first side. At a point, directions and powers are the mean of those of the faces around, weighted by
 * the angles of their corners, each carried into the tangent plane of the point (perpendicular to the sum of the faces'
 * area vectors) by the shortest rotation between the normals. The first axis of that plane, to which PowerField at points
 * refers, is the projection of an edge at the point, which one depends on the order of points and cells.
 *
 * The arrays HarmonicBasis span the fields without divergence and curl: what a face field or a
 * 1-form is free to be where nothing is prescribed, around the handles and holes of the surface.
 * They are orthonormal: the sum over the faces of area times the product of two vectors is 1 for an
 * array with itself, and 0 for two of them; so such sums with any other field are its coefficients.
 * Their unit is 1 / length. Any rotation of the basis would do as well: its choice depends on the
 * order of points and triangles.
 *
 * Port 1, the edges of the surface: vtkPolyData, a line per edge, from the smaller to the larger
 * point index, with the cell array Turning (1 component, radians): by how much the field turns from
 * the face on the left of the edge to the face on the right, in [-pi / N, pi / N]; 0 on boundaries.
 * For 1-forms it also holds the cell array OneForm (1 component, unit of the prescribed vectors
 * times length), the 1-form itself, and, with HarmonicBasis, the cell arrays HarmonicBasis 1, 2,
 * ... k, the 1-forms whose vectors have the same names on the surface.
 *
 * Around an interior point, the turnings across its edges, taken counter-clockwise, and the point's
 * angle defect sum to 2 pi times its SingularityIndex. Of PointPowerField, Turning is along the edge, from the
 * smaller to the larger point index, against transport.
 *
 * Port 2, the convergence: vtkTable, a row per iteration, the first for the start:
 *
 * | column           | unit    | meaning                                       |
 * | ---------------- | ------- | --------------------------------------------- |
 * | Iteration        | -       | 0 for the start                               |
 * | Seconds          | seconds | since the solve began                         |
 * | RelativeResidual | -       | an estimate of the relative error in the energy norm, see below; where nothing is prescribed, of that error times the relative distance to the next eigenvalue (1e-6 is reached there, whatever Tolerance is) |
 * | Energy           | -       | what the system minimises, less its value at X = 0 |
 * | MassResidual     | -       | residual in the mass norm ("energy" in the thesis, section 6.4); only where something is prescribed |
 * | Error            | -       | of X against Cholesky in the mass norm; with CompareWithCholesky |
 * | Returned         | -       | 1 for the row whose X is the result, the best one; else 0 |
 *
 * The start is what the penalties of soft constraints alone hold, or the solution before. The residual r of an equation A X = b
 * is measured in the norm of the V-cycle or factor B that preconditions it, as the root of r.Br, relative to the energy norm of
 * X, the root of X.AX, less that start. As B is close to the inverse of A, this is the relative error in the energy norm but
 * for a factor of about two. With V-cycles the last one may be an estimate, seen at 0.65 to 1.4 times what is measured (116
 * solves). Where it was at most Tolerance, the error in the mass norm was seen below six times Tolerance for
 * weights from 1e-6 to 1e12 (a scan of 31,438 triangles, all fields; mixed weights on smaller surfaces); the residual
 * relative to that of b, which strong constraints dominate, said 1e-8 for errors of 1e-2. Where cycles are poor B is not close:
 * on surfaces that were sheared by 3 to 30, with weights of 1e-6, ConjugateGradients ended with errors of up to 54 times
 * Tolerance; Automatic takes a factor there, since most of their triangles are needles. Of nested iterations and
 * coarse prolongation, which have no B, it is the norm of r over that of the start. Weights that are more than 1e13
 * times what the roughness holds an element with act as if they were as large.
 *
 * The mass norm of v is the root of the sum of M_k v_k^2, and both are relative: |b - A X|_M / |b|_M and
 * |X - X'|_M / |X'|_M. M_k is the area of the face of power fields and face fields, of the point of functions (1 / 3 of
 * the faces around, or as VertexAreas says), and 2 A_e / |e|^2 of the edge of 1-forms, as for m_b.
 *
 * Ports 0 and 2 carry the report as field data, which menus of arrays do not offer (vtkAbstractArray::GUI_HIDE):
 *
 * | field array        | type   | length  | unit, meaning                                     |
 * | ------------------ | ------ | ------- | ------------------------------------------------- |
 * | NumberOfDirections | int    | 1       | N                                                 |
 * | Solver             | string | 1       | what ran, and why if that was not asked for       |
 * | Followed           | string | 1       | arrays, guides and features that the field follows, or "nothing" |
 * | Converged          | int    | 1       | 1 where RelativeResidual of the result is at most Tolerance, else 0; of all solvers |
 * | LevelUnknowns      | double | levels  | unknowns, finest first                            |
 * | LevelNonZeros      | double | levels  | non-zeros of the level's matrix (or factor)       |
 * | OperatorComplexity | double | 1       | non-zeros of all levels over those of the finest  |
 * | SetupSeconds       | double | 1       | last set-up                                       |
 * | PrepareSeconds     | double | 1       | last system stage                                 |
 * | SolveSeconds       | double | 1       | last solve                                        |
 * | SolverBytes        | double | 1       | memory held by matrices, transfers and factors    |
 * | Eigenvalues        | double | components | roughness of the smoothest field per area, 1 / length^2, for each component without prescriptions; only where there are some |
 * | HarmonicBasisSize  | int    | 1       | k, the arrays of HarmonicBasis; only where it acts |
 * | GuidesTaken        | int    | 1       | elements of guides that prescribe a face          |
 * | GuidesTooFar       | int    | 1       | those left out, at least in part, beyond MaximumDistance |
 * | GuidesOnFarSide    | int    | 1       | those left out, at least in part, on the other side of a thin wall |
 * | GuidesPerpendicular | int   | 1       | those left out, at least in part, within 5 degrees of the surface's normal |
 * | GuidesFarthest     | double | 1       | largest distance of what is taken, unit of the points |
 *
 * The last five are there with guides only; their elements are points and cells with vectors, and the
 * segments of lines.
 *
 * @section vtkHarmonicFieldSolver-Execution Execution
 *
 * Three stages; each keeps its result until its own causes change:
 *
 * | stage  | repeated when this changes                                  | cost               |
 * | ------ | ----------------------------------------------------------- | ------------------ |
 * | set-up | the content of points or triangles; operators where they are used, or what asks for other levels; Discretisation and N, unless they were solved for before (up to 1 GiB is kept) | decimation, or samples |
 * | system | which elements are prescribed; weights; other options   | products or factor |
 * | solve  | prescribed vectors; Tolerance, MaximumNumberOfIterations    | iterations         |
 *
 * With singularities, set-up and system depend on the solver alone, and other singularities or another N repeat the
 * solve. The set-up is a factor or levels for the points, and a solve for each handle and hole. Cholesky, VCycles and
 * ConjugateGradients act as they say, all others as Automatic, always on levels of samples; a Tolerance above 1e-6 is taken
 * as that. Alignment and ConstraintType have no effect.
 *
 * A solve starts from the solution before. Other arrays repeat nothing, UnitLength and Combing only
 * the output arrays. HarmonicBasis repeats no stage; its fields are kept until points, triangles or
 * Discretisation change. A solve that does not reach Tolerance gives the best field that it
 * reached, Converged = 0 and a warning; Cholesky refines its solution until it does. Nested iterations and
 * coarse prolongation are approximations, and do not go on until Tolerance: Converged says whether they happen to have reached
 * it, which is hardly ever, without a warning. Where too little is prescribed for the harmonic fields of a
 * surface with handles or holes, 1-forms and face fields leave out what is not determined, with a
 * warning. On surfaces with more than 40 loops around these a factor, which Automatic takes, does not look at
 * the harmonic fields: where they are not determined, it gives another field of the same energy (on a surface of genus 133 with
 * 20 prescribed cells, one that differs by half from that of ConjugateGradients), and Solver says so instead of a warning.
 * Where a surface has too many of them to hold, cycles say so in Solver, too. An aborted run leaves empty
 * outputs and keeps the stages that were complete, and so does an error, as a property out of its range is.
 * Threads and pieces are as in vtkDirectionalProlongation; but results have the same bits only for the same BLAS with the
 * same number of threads of its own, as all solvers factor a matrix, be it that of the coarsest level
 * (OPENBLAS_NUM_THREADS, set before the process starts, fixes them; they are as many as there are processors by default).
 *
 * @sa vtkDirectionalProlongation vtkPrincipalDirections
 */

#ifndef vtkHarmonicFieldSolver_h
#define vtkHarmonicFieldSolver_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkHarmonicFieldSolver : public vtkPolyDataAlgorithm
{
public:
  static vtkHarmonicFieldSolver* New();
  vtkTypeMacro(vtkHarmonicFieldSolver, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Discretisations
  {
    /** N directions per face as their N-th power. */
    PowerField = 0,
    /** A vector per face. */
    FaceField = 1,
    /** A number per edge. */
    OneForm = 2,
    /** A number per point: a function, whose gradient is shown. */
    ScalarFunction = 3,
    /** N directions per point as their N-th power. */
    PointPowerField = 4
  };

  ///@{
  /**
   * What the unknowns are, one of Discretisations. Default PowerField.
   */
  vtkSetMacro(Discretisation, int);
  vtkGetMacro(Discretisation, int);
  ///@}

  ///@{
  /**
   * N, the number of directions per point; of power fields, the others have one. Default 4, range 1
   * to 8.
   */
  vtkSetMacro(NumberOfDirections, int);
  vtkGetMacro(NumberOfDirections, int);
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
   * How prescribed directions act, one of ConstraintTypes. Default Soft.
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

  enum Solvers
  {
    /**
     * Cholesky for small systems, for many solves (ExpectedSolves), where more than 3 % of the triangles are needles,
     * and, for face fields and 1-forms, where more than 40 loops carry harmonic fields; else conjugate gradients.
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
     * Solved on the coarsest level, carried up level by level and smoothed on each: an approximation for the price of a few
     * cycles. Errors were 0.1 to 1 % for power fields on even triangles and up to 16 % on those of CAD models, and up to 20 % for
     * others, where their harmonic fields are well determined. A warning where MaximumNumberOfNestedSweeps ran out.
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
   * How many solves with the same prescribed places and weights are to come, as for a time series of measured
   * directions: Automatic factors the system where a factor would pay (for 30 solves and more of power fields, 40 of
   * 1-forms, 400 of face fields). Default 1, at least 1.
   */
  vtkSetMacro(ExpectedSolves, int);
  vtkGetMacro(ExpectedSolves, int);
  ///@}

  enum CoarseSpaces
  {
    /** Vectors, or values of functions, at samples of the surface or at vertices of the coarse levels; the fast one. */
    Nodal = 0,
    /** Powers, face fields, 1-forms or functions as on the surface, as in the thesis. */
    StructurePreserving = 1
  };

  ///@{
  /**
   * What the coarse levels of multigrid hold, one of CoarseSpaces; without effect on Cholesky.
   * StructurePreserving takes operators of the discretisation (vtkDirectionalProlongation:
   * PowerFields, FaceFields, OneForms). Conjugate gradients then take 11 to 14 iterations for power fields, and
   * 12 to 30 and 13 to 33 for face fields and 1-forms on even surfaces of 14,000 to 100,000 triangles, instead of 5 to 9; on
   * uneven ones (beetle) 33, 58 and more than 100; on needles (cessna, blade, cheese) 55 to more than 100, where a factor
   * takes over as everywhere. Default Nodal.
   */
  vtkSetMacro(CoarseSpace, int);
  vtkGetMacro(CoarseSpace, int);
  ///@}

  ///@{
  /**
   * Gauss-Seidel sweeps before and after the coarse correction of each level, up and down in turn; on
   * nodal levels the surface itself gets three times as many. Those of face fields and 1-forms are over blocks of
   * unknowns there, unless StartingLevel is chosen. Default 2, range 1 to 10.
   */
  vtkSetMacro(Sweeps, int);
  vtkGetMacro(Sweeps, int);
  ///@}

  ///@{
  /**
   * Steps of conjugate gradients, with a V-cycle as preconditioner, that nested iterations take on
   * each level before they sweep (full multigrid); 0 leaves sweeps alone, as in the thesis. Default
   * 2, at least 0.
   */
  vtkSetMacro(NestedCycles, int);
  vtkGetMacro(NestedCycles, int);
  ///@}

  enum NestedRules
  {
    /** After NestedSweeps sweeps. */
    FixedNumber = 0,
    /** After a sweep that lowers the error against Cholesky by less than 0.1 %, as in the thesis.
     */
    WhileErrorFalls = 1,
    /** After a sweep that lowers the level's residual by less than 0.1 %. */
    WhileResidualFalls = 2
  };

  ///@{
  /**
   * When nested iterations go from a level to the next finer one, one of NestedRules. Default
   * FixedNumber.
   */
  vtkSetMacro(NestedRule, int);
  vtkGetMacro(NestedRule, int);
  ///@}

  ///@{
  /**
   * Gauss-Seidel sweeps of nested iterations on each level under the rule FixedNumber. Default 20,
   * at least 0.
   */
  vtkSetMacro(NestedSweeps, int);
  vtkGetMacro(NestedSweeps, int);
  ///@}

  ///@{
  /**
   * Under the other rules nested iterations leave a level after this many sweeps at the latest,
   * with a warning. Default 40,000, which the rules never need: as many times 0.1 % less is less
   * than rounding. At least 0.
   */
  vtkSetMacro(MaximumNumberOfNestedSweeps, int);
  vtkGetMacro(MaximumNumberOfNestedSweeps, int);
  ///@}

  ///@{
  /**
   * The level on which multigrid solves exactly; levels below it are not used. -1 or anything
   * beyond the coarsest: the coarsest. Default -1.
   */
  vtkSetMacro(StartingLevel, int);
  vtkGetMacro(StartingLevel, int);
  ///@}

  enum VertexAreaKinds
  {
    /** Of the places nearest to the point, with care for obtuse triangles. */
    MixedVoronoi = 0,
    /** A third of each triangle around. */
    Barycentric = 1
  };

  ///@{
  /**
   * The areas that belong to the points in the divergence of 1-forms and in the mass of functions, one of
   * VertexAreaKinds.
   * Default MixedVoronoi.
   */
  vtkSetMacro(VertexAreas, int);
  vtkGetMacro(VertexAreas, int);
  ///@}

  ///@{
  /**
   * Whether the system is factored as well, to tell the error of every cycle. Default off.
   */
  vtkSetMacro(CompareWithCholesky, bool);
  vtkGetMacro(CompareWithCholesky, bool);
  vtkBooleanMacro(CompareWithCholesky, bool);
  ///@}

  ///@{
  /**
   * The solve stops at this RelativeResidual (Outputs, port 2). At 1e-4, the default, directions are within 1
   * degree of those at 1e-11 where the length of the field is at least a hundredth of its root mean square, which neither a picture
   * nor a remesher can tell (eight scans of 22,000 to 112,000 triangles, 20 prescribed cells or one short line, all fields). Far from
   * what is prescribed the field fades, the more the higher N is, and they are off by more: on 99.9 % of the area by at most 0.5
   * degrees with 20 cells, and with one line by 0.03, 0.14, 0.5 and 5.6 degrees for N = 1, 2, 4 and 6; at worst by 29. Face fields of
   * one line may fade to nothing. Choose 1e-8 there, and for computations that go on with the numbers. The smoothest field, where
   * nothing is prescribed, is always solved to 1e-6. Against 1e-10, its directions are off by these degrees, at the median, on 99 % of the area and at
   * most (the meshes t01 and t02 of the thesis, fertility and camelhead; 22,000 to 279,000 triangles):
   * N = 1: 0.00001 to 0.00007, 0.0001 to 0.002, 0.001 to 0.06; N = 4: 0.00001 to 0.0003, 0.002 to 1.5, 0.1 to 43. More than 1
   * degree it was only where the field is fainter than 5e-5 of its root mean square, as crosses are on limbs far from the
   * rest; on 99.9 % of the area 4.9 at most. Range 1e-14 to 1.
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
   * length |X|. Default on.
   */
  vtkSetMacro(UnitLength, bool);
  vtkGetMacro(UnitLength, bool);
  vtkBooleanMacro(UnitLength, bool);
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
   * Whether the field follows directions of the surface, with their mask and weights; off, it is as if no arrays were chosen
   * for these. Default on.
   */
  vtkSetMacro(FollowDirections, bool);
  vtkGetMacro(FollowDirections, bool);
  vtkBooleanMacro(FollowDirections, bool);
  ///@}

  ///@{
  /**
   * The guides, input port 1. AddInputConnection(1, output) and AddInputDataObject(1, data) do the
   * same as the first.
   */
  void AddGuidesConnection(vtkAlgorithmOutput* output);
  void RemoveAllGuides();
  ///@}

  /**
   * Chooses an array of the guides, as SetInputArrayToProcess does for the surface: index 0 mask, 1
   * directions, 2 weights; port 1; connection 0, whatever the number of guides; an association of
   * vtkDataObject; a name, of which an empty one or null chooses nothing, the default. (Why not
   * SetInputArrayToProcess: ParaView 5.11 ends where the first index that it knows for a connection
   * is not 0.)
   */
  void SetGuideArrayToProcess(int index, int port, int connection, int association, const char* name);

  ///@{
  /**
   * The same by name alone: directions at points, else on cells; weights at points, else on cells, else in field data.
   * Default empty.
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
   * How far from the surface guides count, and singularities may be, relative to the diagonal of its bounding box. Default
   * 0.1, at least 0.
   */
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  ///@{
  /**
   * How hard the field follows the boundary of the surface, and its sharp edges; see Features above. Default 0, off; a
   * weight is 0 or from 1e-10 to 1e10, or it is an error.
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
   * How hard the field follows principal directions; see Features above. Default 0, off; a weight is 0 or from 1e-10 to
   * 1e10, or it is an error.
   */
  vtkSetMacro(CurvatureWeight, double);
  vtkGetMacro(CurvatureWeight, double);
  ///@}

  ///@{
  /**
   * By how much the field is turned against each of these features, in degrees, counter-clockwise about the normal, besides
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
    /** Along which the surface bends most: around a cylinder, across a ridge, and along a groove. */
    MaximumCurvature = 0,
    /** Along which the surface bends least: along a cylinder and a ridge, and across a groove. */
    MinimumCurvature = 1
  };

  ///@{
  /**
   * Which of the principal directions lines and hexagonal fields (N = 2 and 6) follow, one of CurvatureDirections; N = 4
   * and 8 follow both. Default MaximumCurvature.
   */
  vtkSetMacro(CurvatureDirection, int);
  vtkGetMacro(CurvatureDirection, int);
  ///@}

  ///@{
  /**
   * How far around a point its principal directions look, in units of the mean edge, as vtkPrincipalDirections::Scale.
   * Default 3, range 0 to 100.
   */
  vtkSetMacro(CurvatureScale, double);
  vtkGetMacro(CurvatureScale, double);
  ///@}

  ///@{
  /**
   * By how much the field is turned against all that it follows, in degrees, counter-clockwise about the normal; the
   * rotations of features come on top. Default 0, range -180 to 180.
   */
  vtkSetMacro(Rotation, double);
  vtkGetMacro(Rotation, double);
  ///@}

  ///@{
  /**
   * How often this object has completed each stage; tells what an update reused.
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
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  int Discretisation = PowerField;
  int NumberOfDirections = 4;
  int ConstraintType = Soft;
  double Alignment = 1.0;
  bool FollowDirections = true;
  double MaximumDistance = 0.1;
  double BoundaryWeight = 0.0;
  double BoundaryRotation = 0.0;
  double SharpEdgesWeight = 0.0;
  double SharpEdgesRotation = 0.0;
  double FeatureAngle = 30.0;
  double CurvatureWeight = 0.0;
  double CurvatureRotation = 0.0;
  int CurvatureDirection = MaximumCurvature;
  double CurvatureScale = 3.0;
  double Rotation = 0.0;
  std::string SingularityIndexArray;
  int Solver = Automatic;
  int ExpectedSolves = 1;
  int CoarseSpace = Nodal;
  int Sweeps = 2;
  int NestedCycles = 2;
  int NestedRule = FixedNumber;
  int NestedSweeps = 20;
  int MaximumNumberOfNestedSweeps = 40000;
  int StartingLevel = -1;
  int VertexAreas = MixedVoronoi;
  bool CompareWithCholesky = false;
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 100;
  bool UnitLength = true;
  bool Combing = true;
  bool HarmonicBasis = false;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

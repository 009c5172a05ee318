#ifndef dmgFieldToArrays_h
#define dmgFieldToArrays_h

#include "Adapters/MeshFromPolyData.h"
#include "HarmonicField.h"
#include "Mesh/TangentFrames.h"
#include "Support/ExecutionContext.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkFieldData;
class vtkPolyData;
class vtkTable;

namespace dmg
{

/// The names of all arrays that the filters write. The headers of the filters tell their meaning.
namespace ArrayNames
{

// cells and points
std::string Direction(int k);
inline constexpr const char* PowerField = "PowerField";
inline constexpr const char* FaceField = "FaceField";
inline constexpr const char* Prescribed = "Prescribed";
inline constexpr const char* SingularityIndex = "SingularityIndex";

// cells and edges
/// \param k from 1
std::string HarmonicBasis(int k);

// edges
inline constexpr const char* Turning = "Turning";
inline constexpr const char* OneForm = "OneForm";

// columns of the convergence table
inline constexpr const char* Iteration = "Iteration";
inline constexpr const char* Seconds = "Seconds";
inline constexpr const char* RelativeResidual = "RelativeResidual";
inline constexpr const char* Energy = "Energy";
inline constexpr const char* MassResidual = "MassResidual";
inline constexpr const char* Error = "Error";

// field data: the report
inline constexpr const char* NumberOfDirections = "NumberOfDirections";
inline constexpr const char* Solver = "Solver";
inline constexpr const char* Converged = "Converged";
inline constexpr const char* LevelUnknowns = "LevelUnknowns";
inline constexpr const char* LevelNonZeros = "LevelNonZeros";
inline constexpr const char* OperatorComplexity = "OperatorComplexity";
inline constexpr const char* SetupSeconds = "SetupSeconds";
inline constexpr const char* PrepareSeconds = "PrepareSeconds";
inline constexpr const char* SolveSeconds = "SolveSeconds";
inline constexpr const char* SolverBytes = "SolverBytes";
inline constexpr const char* HarmonicBasisSize = "HarmonicBasisSize";
inline constexpr const char* GuidesTaken = "GuidesTaken";
inline constexpr const char* GuidesTooFar = "GuidesTooFar";
inline constexpr const char* GuidesOnFarSide = "GuidesOnFarSide";
inline constexpr const char* GuidesPerpendicular = "GuidesPerpendicular";
inline constexpr const char* GuidesFarthest = "GuidesFarthest";

// field data: the operators
inline constexpr const char* ProlongationPrefix = "Prolongation.";
inline constexpr const char* ProlongationFormat = "Prolongation.Format";
inline constexpr const char* ProlongationDigest = "Prolongation.Digest";
inline constexpr const char* ProlongationOptions = "Prolongation.Options";
inline constexpr const char* NumbersOfVertices = "Prolongation.NumbersOfVertices";
inline constexpr const char* NumbersOfEdges = "Prolongation.NumbersOfEdges";
inline constexpr const char* NumbersOfFaces = "Prolongation.NumbersOfFaces";
/// \param part "Offsets", "Columns" or "Values" of operator \p name ("S0", "S1", "SX", "SP",
/// "Nodal") of a level.
std::string Prolongation(const std::string& name, int level, const std::string& part);

}

/// A surface with the frames that its fields refer to.
struct FramedSurface
{
  SurfaceMesh Surface;
  TangentFrames Faces;
  TangentFrames Vertices;

  FramedSurface(SurfaceMesh surface, const ExecutionContext& context)
    : Surface(std::move(surface))
    , Faces(FaceFrames(this->Surface.Mesh, context))
    , Vertices(VertexFrames(this->Surface.Mesh, context))
  {
  }
};

/// What the cells, points and edges of a surface show of a field. Kept as long as the field stands,
/// so that other arrays on the surface cost nothing.
struct FieldArrays
{
  bool UnitLength; ///< see vtkHarmonicFieldSolver.h
  bool Combing;
  vtkSmartPointer<vtkFieldData> Cells;
  vtkSmartPointer<vtkFieldData> Points;
  vtkSmartPointer<vtkPolyData> Edges; ///< without points
};

/// \param unknowns of the field, as FieldProblem::Solve returns them.
/// \param input the surface as vtkPolyData.
/// Checkpoints: four, up to half a second per million faces apart.
FieldArrays MakeFieldArrays(const FramedSurface& framed, const Vector<double>& unknowns,
  const FieldOptions& options, bool unitLength, bool combing, vtkPolyData* input,
  const ExecutionContext& context);

/// Adds the arrays of cells and points to \p surface and makes its first direction the active
/// vectors; direction arrays of another N and a harmonic basis that it brought along are removed.
/// Makes \p edges its edges.
void AddFieldArrays(const FieldArrays& arrays, vtkPolyData* surface, vtkPolyData* edges);

/// What the cells and edges of a surface show of its harmonic fields. Kept as long as the surface
/// stands.
struct BasisArrays
{
  Discretisation Kind;
  int NumberOfLoops; ///< how many harmonic fields there are
  bool TooMany;      ///< to hold (AreTooManyToHold): then there are no arrays
  vtkSmartPointer<vtkFieldData> Cells; ///< vectors, one array per field
  vtkSmartPointer<vtkFieldData> Edges; ///< 1-forms, one array per field; empty for face fields
};

/// \pre kind is not PowerField.
/// \param known harmonic fields of this kind (FieldProblem::HarmonicFields); without columns they are computed.
/// \param input the surface as vtkPolyData.
/// \throw SolverFailure as HarmonicForms and HarmonicBasisOfForms.
/// \throw Cancelled
BasisArrays MakeBasisArrays(const FramedSurface& framed, Discretisation kind,
  Eigen::MatrixXd known, vtkPolyData* input, const ExecutionContext& context);

/// Adds the arrays to the cells of the surface and of its edges.
void AddBasisArrays(const BasisArrays& arrays, vtkPolyData* surface, vtkPolyData* edges);

/// Adds the number of arrays to \p fieldData.
void AddBasisSize(const BasisArrays& arrays, vtkFieldData* fieldData);

/// Adds the weights of the prescribed elements to the cells of \p output: the surface, or, for
/// 1-forms, its edges.
void AddPrescribed(const SurfaceMesh& surface, const FieldConstraints& constraints,
  Discretisation kind, vtkPolyData* output);

/// Makes \p table the history of the iterations.
void MakeConvergenceTable(const SolveReport& report, vtkTable* table);

/// Adds sizes, cost and convergence to \p fieldData.
void AddReport(const SolveReport& report, int N, double setupSeconds, vtkFieldData* fieldData);

}

#endif

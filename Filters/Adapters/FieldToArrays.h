#ifndef dmgFieldToArrays_h
#define dmgFieldToArrays_h

#include "Adapters/MeshFromPolyData.h"
#include "Mesh/TangentFrames.h"
#include "Solvers/SolveReport.h"
#include "Systems/AlignmentConstraints.h"

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
inline constexpr const char* Prescribed = "Prescribed";
inline constexpr const char* SingularityIndex = "SingularityIndex";

// edges
inline constexpr const char* Turning = "Turning";

// columns of the convergence table
inline constexpr const char* Iteration = "Iteration";
inline constexpr const char* Seconds = "Seconds";
inline constexpr const char* RelativeResidual = "RelativeResidual";

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

// field data: the operators
inline constexpr const char* ProlongationPrefix = "Prolongation.";
inline constexpr const char* ProlongationFormat = "Prolongation.Format";
inline constexpr const char* ProlongationDigest = "Prolongation.Digest";
inline constexpr const char* ProlongationOptions = "Prolongation.Options";
inline constexpr const char* NumbersOfVertices = "Prolongation.NumbersOfVertices";
inline constexpr const char* NumbersOfFaces = "Prolongation.NumbersOfFaces";
/// \param part "Offsets", "Columns" or "Values" of operator \p name ("S0", "SP", "Nodal") of a level.
std::string Prolongation(const std::string& name, int level, const std::string& part);

}

/// A surface with the frames that its fields refer to.
struct FramedSurface
{
  SurfaceMesh Surface;
  TangentFrames Faces;
  TangentFrames Vertices;

  explicit FramedSurface(SurfaceMesh surface)
    : Surface(std::move(surface))
    , Faces(FaceFrames(this->Surface.Mesh))
    , Vertices(VertexFrames(this->Surface.Mesh))
  {
  }
};

/// Writes a field of N directions to the cells and points of \p output: powers, directions and
/// singularity indices. Direction arrays of other N that \p output brought along are removed.
/// \param powers #F, in the frames of the faces.
/// \param combed whether direction 0 continues from face to face.
void AddPowerField(const FramedSurface& framed, const Vector<Complex>& powers, int N, bool unitLength,
  bool combed, vtkPolyData* output);

/// Writes the weights of the prescribed faces to the cells of \p output.
void AddPrescribed(
  const SurfaceMesh& surface, const PrescribedFaces& prescribed, vtkPolyData* output);

/// Makes \p edges the edges of the surface, as lines between the points of \p input, with the angle by
/// which the field turns across each.
void MakeEdges(const FramedSurface& framed, const Vector<Complex>& powers, int N, vtkPolyData* input,
  vtkPolyData* edges);

/// Makes \p table the history of the iterations.
void MakeConvergenceTable(const SolveReport& report, vtkTable* table);

/// Adds sizes, cost and convergence to \p fieldData.
void AddReport(const SolveReport& report, int N, double setupSeconds, vtkFieldData* fieldData);

}

#endif

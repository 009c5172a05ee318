#ifndef dmgTestPreparedSurface_h
#define dmgTestPreparedSurface_h

#include "Constraints/Constraints.h"
#include "Discretisations/DiscretisationOptions.h"
#include "Mesh/FramedMesh.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/MeshFactory.h"

#include <cmath>
#include <complex>
#include <memory>
#include <vector>

namespace dmg::test
{

inline constexpr DiscretisationKind AllKinds[] = { DiscretisationKind::VertexPowerField, DiscretisationKind::PowerField,
  DiscretisationKind::FaceField, DiscretisationKind::OneForm };

/// Several levels of small surfaces.
inline HierarchyOptions Deep()
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  return options;
}

inline StoppingCriteria Tight()
{
  return { 1e-12, 300 };
}

/// A mesh with everything that a problem needs.
struct PreparedSurface
{
  explicit PreparedSurface(const Surface& surface)
    : Owned(std::make_shared<const FramedMesh>(surface.Mesh()))
    , Operators(BuildSurfaceHierarchy(this->Mesh, Deep(), SerialContext()).Operators)
  {
  }
  std::shared_ptr<const FramedMesh> Owned;
  const FramedMesh& Framed = *this->Owned;
  const TriangleMesh& Mesh = this->Framed.Mesh;
  const TangentFrames& Frames = this->Framed.Faces;
  ProlongationOperators Operators;
};

/// A few directions along a wave over the surface.
inline std::vector<Constraint> WaveOfDirections(const TriangleMesh& mesh, int step)
{
  std::vector<Constraint> directions;
  const TangentFrames frames = FaceFrames(mesh);
  for (int face = 0; face < mesh.NumberOfFaces(); face += step)
  {
    directions.push_back({ face, frames.ToVector(face, std::polar(1.0, 0.01 * face)), 1.0 });
  }
  return directions;
}

/// Those, for discretisations of directions, and values at some vertices, for functions.
inline Constraints Prescriptions(const FramedMesh& surface, int step)
{
  Constraints prescribed{ WaveOfDirections(surface.Mesh, step), {} };
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); vertex += step)
  {
    prescribed.Values.push_back({ vertex, std::sin(0.1 * vertex), 1.0 });
  }
  return prescribed;
}

}

#endif

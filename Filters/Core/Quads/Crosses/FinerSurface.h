#ifndef dmgFinerSurface_h
#define dmgFinerSurface_h

#include "Mesh/FramedMesh.h"
#include "Places/SurfacePlace.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace dmg
{

/// A surface whose long edges have been halved, once or several times. It has the same shape, boundary and sharp edges, and each of its
/// faces is a part of a face of the surface that it was made from, its *parent*.
struct FinerSurface
{
  FramedMesh Geometry; ///< its first vertices are those of the surface that it was made from
  std::vector<int> Parents;
  std::vector<Eigen::Matrix3d> Corners; ///< by face: column k has the barycentric coordinates of corner k in the parent
  std::vector<int>
    NearVertices; ///< by vertex: one of the surface that it was made from, at an end of the same edge or near

  /// The same place on the surface that this one was made from.
  SurfacePlace InParent(const SurfacePlace& place) const;
  /// The halfedge of the parent that a halfedge is a part of, -1 where it runs within the parent.
  int HalfedgeOfParent(int halfedge) const;
  /// The field that has on each face the direction of its parent.
  /// \param surface that this one was made from. \param powers fourth powers of the directions of its faces, in their frames.
  Vector<Complex> PowersOf(const FramedMesh& surface, const Vector<Complex>& powers) const;
  /// The field that has on each parent the direction of its first part.
  Vector<Complex> PowersOfParents(const FramedMesh& surface, const Vector<Complex>& powers) const;
  /// The names of the elements that these are parts of, or near to.
  ElementNames NamesOf(const ElementNames& names) const;
};

/// A part of a face of a surface.
struct PartOfFace
{
  std::array<int, 3> Vertices;
  int Parent;
  Eigen::Matrix3d Corners; ///< as FinerSurface::Corners
};

/// The surface of some parts.
/// \param positions of its vertices. \param nearVertices as FinerSurface::NearVertices.
/// \throw InvalidInput the parts are no manifold.
std::shared_ptr<const FinerSurface> SurfaceOfParts(const std::vector<Vector3>& positions, std::vector<int> nearVertices,
  const std::vector<PartOfFace>& parts, const ExecutionContext& context);

/// Halves edges that are longer than wanted until there are none. A triangle with one long edge becomes two, one with two becomes three, one with
/// three becomes four.
/// \param longest by face, the longest edges that it may have, > 0.
/// \param mostFaces limits the faces in all: where there would be more, edges may be longer everywhere, by one factor.
/// \return null where no edge is too long.
/// Cost: O(#F) of the finer surface, for each time that edges are halved.
std::shared_ptr<const FinerSurface> HalveLongEdges(const FramedMesh& surface, const Vector<double>& longest,
  double mostFaces, const ExecutionContext& context = SerialContext());

}

#endif

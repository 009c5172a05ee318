#ifndef dmgQuadMesh_h
#define dmgQuadMesh_h

#include "Mesh/FramedMesh.h"
#include "Places/SurfacePlace.h"
#include "Quads/Crosses/FinerSurface.h"
#include "Quads/GridCoordinates.h"
#include "Quads/Map/SeamlessMap.h"
#include "Quads/MirrorPlane.h"
#include "Quads/QuadOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// The distances between a surface and its quads.
struct QuadDistances
{
  double LargestFromQuads = 0.0; ///< of the vertices of the surface
  double MeanFromQuads = 0.0;    ///< of these, each with the area around it
  int FarthestVertex = -1; ///< of the surface, or an end of the edge on which the farthest place is; -1: not measured
  Vector3 FarthestPlace = Vector3::Zero(); ///< of the surface from quads
  double InEdges = 0.0;                    ///< LargestFromQuads over the length of edges that is aimed at there
  double LargestFromSurface = 0.0;         ///< of the middles of quads and of their sides
  double MeanFromSurface = 0.0;            ///< of the quads' largest distances, each with its area
  int FarthestQuad = -1;
};

/// The properties of a quad mesh, and how it was made.
struct QuadReport
{
  double LengthOfEdges = 0.0;          ///< that was aimed at, before local refinement
  double MeanLength = 0.0;             ///< the side of a square of the mean area of the quads
  int Singularities = 0;               ///< of the field, after splitting
  int SplitSingularities = 0;          ///< of an index of 1/2 or more that were split
  int IrregularVertices = 0;           ///< inner vertices that have not four quads
  int IrregularWithoutSingularity = 0; ///< of these, the ones that are at no singularity of the field
  int FlippedFaces = 0;                ///< of the surface, that the map turns over
  int FacesWithoutArea = 0;            ///< of the surface, that the map takes to a line or a point
  int InvertedQuads = 0;               ///< of a negative scaled Jacobian: folded, not convex or upside down
  double MeanScaledJacobian = 0.0;
  int EulerOfSurface = 0; ///< without what is left out
  int EulerOfMesh = 0;
  int Refinements = 0; ///< rounds in which edges were halved somewhere
  /// Sides of faces of the surface, as halfedges, on the boundary and between regions, that edges of quads follow though the field is off by more than
  /// AlignmentOptions::LargestDeviation; ascending.
  std::vector<int> AgainstField = {};
  std::vector<int> RefinedFaces = {}; ///< of the surface, where they are shorter than was aimed at; ascending
  int SplitFaces = 0;                 ///< of components that no other quads fit: three quads each, or more
  int LeftOut = 0;                    ///< components of two faces back to back that no quads fit
  double LengthScale = 1.0; ///< by which lengths were scaled after they had been fitted to the number of quads
  bool IsShortened = false; ///< whether that was as longer edges do not fit the surface
  int LostRegions = 0;      ///< numbers of AlignmentOptions::Regions that no quad has
  int CutOff = 0;           ///< twice the number of places where a thin part at the boundary may be lost
  QuadDistances Distances = {};
  std::vector<double>
    AreaShares = {};     ///< by component of the surface (FaceComponents): the area of its quads over its own
  int LeastCovered = -1; ///< a face of the component of the smallest share
  double AskedRatio =
    1.0; ///< of the largest to the smallest of the lengths of edges that Sizes and Adaptivity of QuadOptions give
  double ReachedRatio = 1.0; ///< AskedRatio to the power by which the lengths of edges follow those on the mean
  /// The largest distance of the surface from its mirror image, relative to its diagonal; 0 where nobody asked for symmetry.
  double Asymmetry = 0.0;
  bool IsSymmetric = false; ///< whether the mesh is its own mirror image about Mirror
  MirrorPlane Mirror = {};
  /// Empty, or why there are no quads: what of the surface they would lose, and a remedy.
  std::string Error = {};
};

/// A pure quad mesh of a surface, and the map that it comes from.
struct QuadMesh
{
  std::vector<std::array<int, 4>> Quads; ///< counter-clockwise seen from outside
  std::vector<int> Faces;                ///< by quad, a face of the surface under it
  Points Positions;                      ///< of vertices
  std::vector<SurfacePlace> Places;      ///< of vertices on the surface
  std::vector<char> IsOnBoundary;        ///< by vertex
  std::vector<int> Valences;             ///< by vertex, the number of its quads
  std::vector<int> Singularities; ///< by vertex, the number of singular vertices of the surface that it stands for
  Vector<double> ScaledJacobians; ///< by quad, see QuadSmoothing.h
  /// The integers u and v of each quad's corners. They go on from quad to quad but across cuts (LayOutOnGrid).
  std::vector<CornersInGrid> Grid;

  /// The surface with its long edges halved, which the map is of; null where there are none.
  std::shared_ptr<const FinerSurface> Finer;
  MapOfCorners Map;        ///< seamless, by corner of Finer; integers are the vertices' coordinates
  std::vector<char> IsCut; ///< by edge of Finer: whether the map jumps there

  QuadReport Report;
};

/// The surface that quads are made of: a map has no room to bend within triangles that are larger than quads, so edges that are longer than
/// those of quads are halved first. MakeQuads does so; call it for a field that is to be found there.
/// \return null where the surface serves as it is. There are at most 25 triangles for each quad, or half as many more than before.
/// \throw InvalidInput an option is out of range; there would be more than ten million quads.
std::shared_ptr<const FinerSurface> SurfaceForQuads(const FramedMesh& surface, const QuadOptions& options,
  const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

/// Makes a pure quad mesh whose edges follow a cross field. See Quads.md for the method.
///
/// The mesh has the Euler number of the surface, and each edge has a quad on each side, except on the boundary. Where quads are too
/// large for a handle, a hole, a component or a limb, edges are halved there and around it, in up to 14 rounds. If that does not help, a
/// component of few faces has three quads for each of them; else all edges are halved, twice at most. If that does not help either,
/// there are no quads and QuadReport::Error says why; the map is there.
///
/// The number of quads is as near to the one that is asked for as three tries bring it.
///
/// \param powers the fourth powers of the field's directions, one per face in its frame. A field that follows the boundary and sharp
///   edges gives edges along them (FeatureOptions).
/// \param names says how messages call faces and vertices.
/// \return the same bits for any number of threads.
/// \throw InvalidInput an option is out of range, or the number of powers is not that of faces, or one is not finite; there would be more
///   than ten million quads.
/// Cost: a sparse factor of a Laplacian of the vertices with two unknowns each, a solve per integer, of which there are some for each
/// singularity, handle and hole, and the cube of their number.
QuadMesh MakeQuads(const FramedMesh& surface, const Vector<Complex>& powers, const QuadOptions& options = {},
  const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

/// The same with a field on the surface that SurfaceForQuads has made.
/// \param finer null: the field is one of the surface, whose long edges stay.
/// \param powers by face of \p finer.
QuadMesh MakeQuads(const FramedMesh& surface, std::shared_ptr<const FinerSurface> finer, const Vector<Complex>& powers,
  const QuadOptions& options = {}, const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

}

#endif

#ifndef dmgBendOfRegions_h
#define dmgBendOfRegions_h

#include "Directions/PrincipalDirections.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceSizes.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
#include <vector>

namespace dmg
{

/// The shape operator, symmetric in space, integrated over a part of the surface.
struct BendOfPart
{
  Eigen::Matrix3d Bend = Eigen::Matrix3d::Zero();
  double Area = 0.0;

  BendOfPart& operator+=(const BendOfPart& other)
  {
    this->Bend += other.Bend;
    this->Area += other.Area;
    return *this;
  }
};

/// The normals of vertices, #V x 3.
Points NormalsOfVertices(const FramedMesh& surface, const ExecutionContext& context);

/// Whether each vertex is on the boundary, #V.
std::vector<char> AreOnBoundary(const TriangleMesh& mesh);

/// The integrals over a third of each face around a vertex. Faces that touch the boundary, where normals look to one side, have nearly no
/// weight: they count where there are no others alone.
/// \param normals, isOnBoundary of vertices.
std::vector<BendOfPart> BendsOfVertices(const FramedMesh& surface, const Points& normals,
  const std::vector<char>& isOnBoundary, const ExecutionContext& context);

/// The size of the regions of FindPrincipalDirections.
struct RegionSize
{
  RegionSize(double scale, const SurfaceSizes& sizes);

  double Expected; ///< number of vertices, and a few more
  double SquaredRadius;
  std::size_t Limit; ///< of the number of vertices, and of the neighbours that are looked at beyond the first vertex
};

/// Visits the neighbours of a vertex, counter-clockwise, while visit(neighbour) says to go on.
template <class Visit>
void VisitVerticesAround(const TriangleMesh& mesh, int vertex, const Visit& visit)
{
  const int first = mesh.OutgoingHalfedge(vertex);
  bool goesOn = true;
  for (int h = first; goesOn && h >= 0;)
  {
    const int previous = TriangleMesh::Previous(h);
    const int next = mesh.Twin(previous);
    goesOn = visit(mesh.Head(h)) && (next >= 0 || visit(mesh.Tail(previous))) && next != first;
    h = next;
  }
}

/// Sums over the regions of vertices, one after the other.
/// \tparam Graph of vertices has Position(vertex), Part(vertex) and VisitNeighbours(vertex, visit), which ends where
/// visit(neighbour) says so.
template <class Graph>
class SumsOverRegions
{
public:
  SumsOverRegions(const Graph& graph, int numberOfVertices, const RegionSize& size)
    : Of(graph)
    , Size(size)
    , RegionOf(numberOfVertices, -1)
  {
  }

  BendOfPart Around(int centre)
  {
    const Vector3 position = this->Of.Position(centre);
    BendOfPart sum;
    this->Region.assign(1, centre);
    this->RegionOf[centre] = centre;
    for (std::size_t i = 0; i < this->Region.size(); ++i) // grows meanwhile
    {
      sum += this->Of.Part(this->Region[i]);
      std::size_t looks = 0;
      this->Of.VisitNeighbours(this->Region[i],
        [&](int vertex)
        {
          const bool isInside = i == 0 ||
            (this->Region.size() < this->Size.Limit &&
              (this->Of.Position(vertex) - position).squaredNorm() < this->Size.SquaredRadius);
          if (isInside && this->RegionOf[vertex] != centre)
          {
            this->RegionOf[vertex] = centre;
            this->Region.push_back(vertex);
          }
          // All regions beside a vertex of many neighbours would else look at all of these.
          return i == 0 || ++looks < this->Size.Limit;
        });
    }
    return sum;
  }

private:
  const Graph& Of;
  const RegionSize Size;
  std::vector<int> RegionOf; ///< the last one that a vertex was in
  std::vector<int> Region;
};

/// The curvatures of faces from the sums over the regions of vertices.
/// \param diagonal of the box around the surface.
PrincipalCurvatures CurvaturesOfFaces(const FramedMesh& surface, const std::vector<BendOfPart>& ofRegions,
  double diagonal, const ExecutionContext& context);

}

#endif

#ifndef dmgParallelTransport_h
#define dmgParallelTransport_h

#include "Constraints/Constraints.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/PositiveSide.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// The options of parallel transport.
struct TransportOptions
{
  /// The time of the diffusion by which maps find angles, as a multiple of the mean squared edge length, from 0.01 to 1000. With longer times heat
  /// takes more ways beside the shortest one. With shorter ones the edges of the mesh bend its way.
  double TimeStep = 2.0;

  friend bool operator==(const TransportOptions& a, const TransportOptions& b)
  {
    const auto& [timeStep] = a; // all members
    return timeStep == b.TimeStep;
  }
};

/// A vector field that was carried from its sources.
struct TransportedField
{
  Vector<Complex> AtVertices;        ///< in VertexFrames; zero on components without a source
  Vector<Complex> OnFaces;           ///< in FaceFrames
  int WithoutSource = 0;             ///< vertices on components without a source
  std::vector<std::string> Warnings; ///< one sentence each
};

/// The logarithmic map of a vertex: its value at p is the vector at the vertex with the direction in which the shortest
/// path to p starts, and its length. Paths go around holes. NaN on other components.
struct LogarithmicMap
{
  /// #V, in the frame whose first axis is the direction that was asked for; moduli are Distances, arguments Angles.
  Vector<Complex> Coordinates;
  Vector<double> Distances; ///< along the surface, >= 0
  Vector<double> Angles; ///< in radians, from -pi to pi, counter-clockwise seen from the positive side (PositiveSide.h)
  int Unreached = 0;     ///< vertices on other components
};

/// Carries tangent vectors from a few places to everywhere along shortest paths, and finds logarithmic maps.
/// ParallelTransport.md has the formulas.
///
///   dmg::ParallelTransport transport(surface);
///   const dmg::TransportedField field = transport.Carry(sources);
///   const dmg::LogarithmicMap map = transport.Map(vertex, 1.0);
///
/// Paths are those of a wavefront over the intrinsic Delaunay triangulation (FindShortestPaths), so bad triangles do no harm. Where they do not
/// bend around a hole, angles of maps are those of the affine heat method (Soliman and Sharp 2025). Its matrices are factored: far from a
/// source heat is e^-300 of that at the source, and only a factor has digits there.
/// Cost: O(#V log #V) for a field. A real and a complex sparse factor of #V unknowns at the first map, and three solves for each.
class ParallelTransport
{
public:
  /// \param surface is borrowed.
  /// \throw InvalidInput the time step is out of range.
  /// \throw Cancelled
  explicit ParallelTransport(
    const FramedMesh& surface, const TransportOptions& options = {}, const ExecutionContext& context = SerialContext());
  ~ParallelTransport();
  ParallelTransport(ParallelTransport&&) noexcept;

  /// Each place has the direction and the length of the vector of the nearest source, and a face the mean direction and the mean length of its
  /// corners.
  /// \param sources directions at vertices and on faces; their tangential part is carried, at vertices without that along
  ///   NormalOfVertex. Weights are the shares of copies. Several
  ///   at one vertex are averaged.
  /// \throw InvalidInput there is none; a direction is not finite, zero, perpendicular to the surface, or on no element; CheckSizes.
  /// \throw Cancelled
  TransportedField Carry(const Constraints& sources, const ExecutionContext& context = SerialContext());

  /// \param direction of the angle 0, in the frame of the vertex; its length does not count.
  /// \throw InvalidInput there is no such vertex; the direction is zero or not finite.
  /// \throw Cancelled
  LogarithmicMap Map(int vertex, Complex direction, const ExecutionContext& context = SerialContext());

  /// The positive side, from which angles are counter-clockwise.
  const SidesOfSurface& Sides() const;

  /// The time of the diffusion at each vertex, in squared units of length: one number per component.
  const Vector<double>& Times() const;
  /// The memory of the factors.
  long long Bytes() const;
  /// The numbers of factorisations and of solves.
  struct StageCounts
  {
    int Setups = 0;
    int Solves = 0;

    friend StageCounts operator+(const StageCounts& a, const StageCounts& b)
    {
      return { a.Setups + b.Setups, a.Solves + b.Solves };
    }
  };
  StageCounts Counts() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif

#include "Singularities/PrescribedSingularities.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <cmath>
#include <sstream>

namespace dmg
{

int TimesOfIndex(double index, int N, const std::string& name)
{
  constexpr double Rounding = 1e-4; // of 32-bit numbers, and of those that people write
  constexpr double Largest = 1e6;
  const double times = N * index;
  if (!(std::abs(times - std::round(times)) <= Rounding) || !(std::abs(times) <= Largest))
  {
    throw InvalidInput("the index of " + name + " is " + ShortText(index) + ", and a field of " + std::to_string(N) +
      (N == 1 ? " direction" : " directions") + " has singularities of multiples of " +
      (N == 1 ? "1" : "1/" + std::to_string(N)) + "; choose one of these, or another " + TextOf(Remedy::Directions));
  }
  return static_cast<int>(std::lround(times));
}

std::vector<int> TimesByVertex(
  const TriangleMesh& mesh, const std::vector<PrescribedSingularity>& singularities, const ElementNames& names)
{
  std::vector<int> times(mesh.NumberOfVertices(), 0);
  for (const auto& [vertex, ofOne] : singularities)
  {
    if (vertex < 0 || vertex >= mesh.NumberOfVertices())
    {
      throw InvalidInput("a singularity is prescribed at vertex " + std::to_string(vertex) + ", and there are " +
        std::to_string(mesh.NumberOfVertices()) + " vertices; prescribe it at one of these");
    }
    if (mesh.IsBoundaryVertex(vertex) && ofOne != 0)
    {
      throw InvalidInput("a singularity is prescribed at " + names.Vertex(vertex) +
        ", on the boundary of the surface; move it inside, or leave it out: what the others leave "
        "over comes to the boundary by itself");
    }
    times[vertex] += ofOne;
  }
  return times;
}

}

#include "Singularities/SurfaceHolonomy.h"

#include "Operators/FunctionSource.h"
#include "Singularities/PrescribedSingularities.h"
#include "Singularities/TrivialConnection.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dmg
{

SurfaceHolonomy::SurfaceHolonomy(const FramedMesh& surface, const ExecutionContext& context)
  : Trees(MakeTreeCotree(surface.Mesh, BoundaryAs::Vertex))
  , Loops(GeneratorsOverFaces(surface.Mesh, this->Trees))
  , Sides(SideDirections(surface.Mesh, surface.Faces, context))
  , Defects(
      AngleDefects(surface.Mesh, Corners(surface.Mesh, this->Sides, surface.Faces, surface.Vertices, context), context))
  , AlongGenerators(RotationOfTransport(surface.Mesh, this->Sides, this->Loops))
  , Components(VertexComponents(surface.Mesh))
{
  const int components = *std::max_element(this->Components.begin(), this->Components.end()) + 1;
  this->FirstVertices.assign(components, -1);
  this->AreClosed.assign(components, 1);
  for (int vertex = surface.Mesh.NumberOfVertices() - 1; vertex >= 0; --vertex)
  {
    this->FirstVertices[this->Components[vertex]] = vertex;
    this->AreClosed[this->Components[vertex]] &= !surface.Mesh.IsBoundaryVertex(vertex);
  }
}

void SurfaceHolonomy::CheckSums(const std::vector<int>& times, int N, const ElementNames& names) const
{
  Vector<double> defects = Vector<double>::Zero(this->NumberOfComponents());
  std::vector<long long> sums(this->NumberOfComponents(), 0);
  for (std::size_t vertex = 0; vertex < times.size(); ++vertex)
  {
    defects[this->Components[vertex]] += this->Defects[vertex];
    sums[this->Components[vertex]] += times[vertex];
  }
  for (int component = 0; component < this->NumberOfComponents(); ++component)
  {
    const auto characteristic = std::llround(defects[component] / (2.0 * Pi)); // Gauss and Bonnet
    const long long missing = N * characteristic - sums[component];
    if (!this->AreClosed[component] || missing == 0)
    {
      continue;
    }
    const std::string where = this->NumberOfComponents() == 1
      ? "the surface"
      : "the component of " + names.Vertex(this->FirstVertices[component]);
    throw InvalidInput("the indices of the singularities on " + where + " sum to " +
      ShortText(static_cast<double>(sums[component]) / N) + ", and its Euler characteristic is " +
      std::to_string(characteristic) + "; " + (missing > 0 ? "add singularities of " : "take away ") +
      ShortText(static_cast<double>(std::abs(missing)) / N) + " in all");
  }
}

}

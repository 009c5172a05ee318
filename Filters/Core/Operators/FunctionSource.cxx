#include "Operators/FunctionSource.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// A sum that is smaller, relative to the sum of magnitudes, is rounding.
constexpr double RoundingOfSums = 1e-9;

}

Vector<double> IntegratedSource(const TriangleMesh& mesh, const Vector<double>& f)
{
  Vector<double> integrals = Vector<double>::Zero(mesh.NumberOfVertices());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const auto corners = mesh.FaceCorners().row(face);
    const double sum = f[corners[0]] + f[corners[1]] + f[corners[2]];
    const double share = mesh.FaceArea(face) / 12.0;
    for (int k = 0; k < 3; ++k)
    {
      integrals[corners[k]] += share * (sum + f[corners[k]]);
    }
  }
  return integrals;
}

Vector<double> IntegratedSource(const TriangleMesh& mesh)
{
  return IntegratedSource(mesh, Vector<double>::Ones(mesh.NumberOfVertices()));
}

void CheckNetSource(double sum, double sumOfMagnitudes, const std::string& part)
{
  if (std::abs(sum) > RoundingOfSums * sumOfMagnitudes)
  {
    throw InvalidInput("the source sums to " + ShortText(sum) + (part.empty() ? "" : " on " + part) +
      ", where no value is held and nothing leaves; hold a value there, or have its mean taken out (" +
      TextOf(Remedy::NoNetSource) + ")");
  }
}

std::vector<int> VertexComponents(const TriangleMesh& mesh)
{
  const std::vector<int> ofFaces = FaceComponents(mesh);
  std::vector<int> components(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    components[vertex] = ofFaces[TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertex))];
  }
  return components;
}

FreeComponents::FreeComponents(const std::vector<int>& components, const std::vector<int>& prescribed)
  : FreeComponents(components, *std::max_element(components.begin(), components.end()) + 1, prescribed, {})
{
}

FreeComponents::FreeComponents(
  const std::vector<int>& components, int bound, const std::vector<int>& prescribed, SumOverProcesses sum)
  : Components(components)
  , Sum(std::move(sum))
  , AreFree(bound, 1)
{
  Vector<double> holding = Vector<double>::Zero(bound); // vertices
  for (const int vertex : prescribed)
  {
    ++holding[components[vertex]];
  }
  if (this->Sum)
  {
    this->Sum(holding.data(), bound);
  }
  std::transform(holding.begin(), holding.end(), this->AreFree.begin(), [](double number) { return number == 0.0; });
}

FreeComponents FreeComponents::Of(const std::vector<int>& components, const std::vector<int>& vertices)
{
  FreeComponents free(components, {});
  std::fill(free.AreFree.begin(), free.AreFree.end(), 0);
  for (const int vertex : vertices)
  {
    free.AreFree[components[vertex]] = 1;
  }
  return free;
}

bool FreeComponents::AreAny() const
{
  return std::find(this->AreFree.begin(), this->AreFree.end(), 1) != this->AreFree.end();
}

std::vector<int> FreeComponents::FirstVertices() const
{
  std::vector<int> firsts;
  std::vector<char> isPending = this->AreFree;
  for (std::size_t vertex = 0; vertex < this->Components.size(); ++vertex)
  {
    if (isPending[this->Components[vertex]])
    {
      isPending[this->Components[vertex]] = 0;
      firsts.push_back(static_cast<int>(vertex));
    }
  }
  return firsts;
}

Vector<double> FreeComponents::Sums(const Vector<double>& numbers) const
{
  Vector<double> sums = Vector<double>::Zero(static_cast<Eigen::Index>(this->AreFree.size()));
  for (Eigen::Index vertex = 0; vertex < numbers.size(); ++vertex)
  {
    const int component = this->Components[vertex];
    sums[component] += this->AreFree[component] ? numbers[vertex] : 0.0;
  }
  if (this->Sum)
  {
    this->Sum(sums.data(), static_cast<int>(sums.size()));
  }
  return sums;
}

void FreeComponents::Balance(Vector<double>& source, const Vector<double>& areas, NetSource net) const
{
  const Vector<double> sums = this->Sums(source);
  if (net == NetSource::Refuse)
  {
    const Vector<double> magnitudes = this->Sums(source.cwiseAbs());
    for (Eigen::Index component = 0; component < sums.size(); ++component)
    {
      CheckNetSource(sums[component], magnitudes[component],
        sums.size() > 1 ? "component " + std::to_string(component) : std::string());
    }
    return;
  }
  const Vector<double> ofComponents = this->Sums(areas);
  for (Eigen::Index vertex = 0; vertex < source.size(); ++vertex)
  {
    const int component = this->Components[vertex];
    source[vertex] -= this->AreFree[component] ? areas[vertex] * (sums[component] / ofComponents[component]) : 0.0;
  }
}

void FreeComponents::Centre(Vector<double>& u, const Vector<double>& areas) const
{
  const Vector<double> integrals = this->Sums(areas.cwiseProduct(u));
  const Vector<double> ofComponents = this->Sums(areas);
  for (Eigen::Index vertex = 0; vertex < u.size(); ++vertex)
  {
    const int component = this->Components[vertex];
    u[vertex] -= this->AreFree[component] ? integrals[component] / ofComponents[component] : 0.0;
  }
}

void FreeComponents::VanishAt(const std::vector<int>& vertices, Vector<double>& u) const
{
  Vector<double> shifts = Vector<double>::Zero(static_cast<Eigen::Index>(this->AreFree.size()));
  for (const int vertex : vertices)
  {
    shifts[this->Components[vertex]] = u[vertex];
  }
  for (Eigen::Index vertex = 0; vertex < u.size(); ++vertex)
  {
    u[vertex] -= shifts[this->Components[vertex]];
  }
}

}

#ifndef dmgBenchmarksPrescriptions_h
#define dmgBenchmarksPrescriptions_h

#include "Discretisations/Discretisation.h"
#include "Support/Random.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

/// What the benchmarks prescribe.
namespace dmg::benchmarks
{

/// The names of the tables; the thesis's, where it has one.
inline std::string NameOf(DiscretisationKind kind)
{
  switch (kind)
  {
    case DiscretisationKind::OneForm:
      return "DEC";
    case DiscretisationKind::FaceField:
      return "face-based";
    case DiscretisationKind::ScalarFunction:
      return "scalar";
    case DiscretisationKind::VertexPowerField:
      return "points";
    default:
      return "power";
  }
}

/// How many elements are prescribed.
struct Regime
{
  std::string Name;
  int Count;    ///< or, if 0,
  double Share; ///< of all elements

  int Of(int elements) const
  {
    return std::min(elements, this->Count > 0 ? this->Count : static_cast<int>(std::ceil(this->Share * elements)));
  }
};

/// Random elements with weight 1: faces and vertices with random directions of unit length, edges with the integrals of such
/// in their planes, vertices of functions with values between -1 and 1.
/// \param mesh of the field.
inline FieldConstraints RandomConstraints(
  const TriangleMesh& mesh, const Discretisation& field, const Regime& regime, test::Random& random)
{
  constexpr double pi = 3.14159265358979323846;
  const int elements = field.NumberOfElements();
  std::set<int> chosen;
  while (static_cast<int>(chosen.size()) < regime.Of(elements))
  {
    chosen.insert(random.Index(elements));
  }
  FieldConstraints constraints;
  constraints.Elements.assign(chosen.begin(), chosen.end());
  const int size = static_cast<int>(chosen.size());
  constraints.Weights.assign(size, 1.0);
  constraints.Values.resize(field.UnknownsPerElement() * size);
  for (int b = 0; b < size; ++b)
  {
    if (field.Elements() == ElementKind::Vertices && field.UnknownsPerElement() == 1)
    {
      constraints.Values[b] = random.Uniform(-1.0, 1.0);
      continue;
    }
    const double angle = random.Uniform(0.0, 2.0 * pi);
    if (field.Elements() == ElementKind::Edges)
    {
      const auto [i, j] = mesh.EdgeVertices(constraints.Elements[b]);
      constraints.Values[b] = (mesh.Position(j) - mesh.Position(i)).norm() * std::cos(angle);
    }
    else
    {
      constraints.Values[2 * b] = std::cos(angle);
      constraints.Values[2 * b + 1] = std::sin(angle);
    }
  }
  return constraints;
}

}

#endif

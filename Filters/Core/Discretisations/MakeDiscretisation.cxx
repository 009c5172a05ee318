#include "Discretisations/MakeDiscretisation.h"

#include "Discretisations/FaceField.h"
#include "Discretisations/OneForm.h"
#include "Discretisations/PowerField.h"
#include "Discretisations/ScalarFunction.h"
#include "Discretisations/VertexPowerField.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

namespace dmg
{

std::unique_ptr<const Discretisation> MakeDiscretisation(
  const DiscretisationOptions& options, const FramedMesh& surface, const VertexConnection* connection)
{
  switch (options.Kind)
  {
    case DiscretisationKind::ScalarFunction:
      return std::make_unique<ScalarFunction>(surface, options.Areas);
    case DiscretisationKind::OneForm:
      return std::make_unique<OneForm>(surface, options.Areas);
    case DiscretisationKind::FaceField:
      return std::make_unique<FaceField>(surface);
    case DiscretisationKind::VertexPowerField:
      return std::make_unique<VertexPowerField>(surface, options.N, connection);
    default:
      return std::make_unique<PowerField>(surface, options.N);
  }
}

std::string ReasonForOneProcess(const DiscretisationOptions& options)
{
  switch (options.Kind)
  {
    case DiscretisationKind::FaceField:
    case DiscretisationKind::OneForm:
      return "flows are found on one process";
    case DiscretisationKind::PowerField:
      return "power fields on faces are found on one process, unlike those at points";
    default:
      return "";
  }
}

DiscretisationOptions OptionsThatCount(const DiscretisationOptions& options)
{
  DiscretisationOptions counting;
  counting.Kind = options.Kind;
  switch (options.Kind)
  {
    case DiscretisationKind::ScalarFunction:
    case DiscretisationKind::OneForm:
      counting.Areas = options.Areas;
      break;
    case DiscretisationKind::PowerField:
    case DiscretisationKind::VertexPowerField:
      counting.N = options.N;
      break;
    case DiscretisationKind::FaceField:
      break;
  }
  return counting;
}

DiscretisationOptions WithSingularitiesAtVertices(const DiscretisationOptions& options)
{
  if (options.Kind != DiscretisationKind::PowerField && options.Kind != DiscretisationKind::VertexPowerField)
  {
    throw InvalidInput(
      "singularities are prescribed, and only power fields can have them; " + TextOf(Remedy::NoSingularities));
  }
  DiscretisationOptions onFaces = options;
  onFaces.Kind = DiscretisationKind::PowerField;
  return onFaces;
}

std::vector<std::string> NamesOfValues()
{
  return { "PowerField", "FaceField", "OneForm", "ScalarFunction" };
}

}

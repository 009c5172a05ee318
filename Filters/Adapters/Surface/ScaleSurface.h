#ifndef dmgScaleSurface_h
#define dmgScaleSurface_h

#include "Adapters/Surface/PreparedDataSet.h"
#include "Directions/PowerFieldDirections.h"
#include "Scales/FlowScales.h"
#include "Scales/ScaleFilter.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

namespace dmg
{

/// Scale filters for the surface of a dataset, kept for the next call on the same surface. Keys are contents, not modification times.
class ScaleSurface
{
public:
  /// All that the filters depend on.
  struct Settings
  {
    int Order = 2;
    double LengthScale = 1.0;
    SolverKind Solver = SolverKind::Automatic;
    FlowBoundary Boundary = FlowBoundary::Closed;
    bool IsGlobe = false;                         ///< see HodgeDecomposition
    std::vector<double> RelativeWavelengths = {}; ///< see ScaleFilterOptions

    bool IsEqual(const Settings& other) const
    {
      const auto members = [](const Settings& settings)
      {
        const auto& [order, scale, solver, boundary, isGlobe, relative] =
          settings; // all of them, or it does not compile
        return std::tie(order, scale, solver, boundary, isGlobe, relative);
      };
      return members(*this) == members(other);
    }
  };

  /// Takes another surface or other settings, if they are others.
  void SetSurface(
    const std::shared_ptr<const PreparedDataSet>& surface, const Settings& settings, const ExecutionContext& context);

  /// Makes a scale filter on a surface that somebody else has prepared.
  using MakeFilter = std::function<ScaleFilter(const ScaleFilterOptions&, const ExecutionContext&)>;
  /// Takes such a surface with filters for functions and for vectors as wholes, until Forget.
  /// \param surface is borrowed.
  void SetFilters(const FramedMesh& surface, const Settings& settings, MakeFilter make);
  /// Lets go of the surface.
  void Forget();

  /// The surface.
  const FramedMesh& On() const { return this->OfOthers ? *this->OfOthers : this->Prepared->Geometry; }
  const Settings& Given() const { return this->SettingsOfFilters; }
  /// The filters, which are made where there are none.
  ScaleFilter& OfFunctions(const ExecutionContext& context)
  {
    return this->Take(this->Functions, ScaledQuantity::Function, context);
  }
  ScaleFilter& OfVectors(const ExecutionContext& context)
  {
    return this->Take(this->Vectors, ScaledQuantity::Vectors, context);
  }
  FlowScales& OfFlows(const ExecutionContext& context);
  /// The parts of flows on faces. \pre SetSurface.
  HodgeDecomposition& Decomposition() { return *this->PartsOfFlows; }
  /// A flow on faces at the vertices. \pre SetSurface.
  Vector<Complex> AtVertices(const Vector<Complex>& onFaces, const ExecutionContext& context) const
  {
    return PowersAtVertices(this->On().Mesh, this->CornersOfFaces, onFaces, 1, context);
  }

  struct StageCounts
  {
    int Setups = 0; ///< of solvers on the surface
    int Splits = 0; ///< of quantities at wavelengths, with those of spectra
  };
  /// Over all surfaces.
  const StageCounts& Counts() const { return this->CountsOfStages; }
  void CountSplits(int number) { this->CountsOfStages.Splits += number; }

private:
  ScaleFilterOptions OptionsOf(ScaledQuantity quantity) const;
  ScaleFilter& Take(std::optional<ScaleFilter>& filter, ScaledQuantity quantity, const ExecutionContext& context);

  Settings SettingsOfFilters;
  std::shared_ptr<const PreparedDataSet> Prepared;
  const FramedMesh* OfOthers = nullptr; ///< the surface of SetFilters
  MakeFilter Make;
  Unfilled<Corner> CornersOfFaces;
  // These refer to the surface, and share the set-ups of the first.
  std::optional<HodgeDecomposition> PartsOfFlows;
  std::optional<ScaleFilter> Functions, Vectors;
  std::optional<FlowScales> Flows;
  StageCounts CountsOfStages;
};

}

#endif

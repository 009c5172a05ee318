#ifndef dmgScalesToArrays_h
#define dmgScalesToArrays_h

#include "Adapters/Input/QuantitiesFromArrays.h"
#include "Adapters/Surface/PreparedDataSet.h"
#include "Adapters/View/SurfaceView.h"
#include "Directions/PowerFieldDirections.h"
#include "Scales/FlowScales.h"
#include "Scales/ScaleFilter.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

class vtkTable;

namespace dmg
{

/// The results of a scale filter that somebody wants.
struct ScaleOptions
{
  std::vector<double>
    Wavelengths; ///< in the unit of the points times the length scale; empty: one of ten mean edges, or 1 where it varies
  bool AreWholes = false;  ///< vectors are filtered as wholes rather than by their parts
  bool PartsApart = false; ///< of flows that are not, both parts are written, too
  double Tolerance = 1e-6;
  bool HasSpectrum = true;
  double SpectrumFrom = 0.0; ///< wavelengths; 0: four mean edges
  double SpectrumTo = 0.0;   ///< 0: twice the root of the area
  int SpectrumRows = 24;
};

/// A function of a dataset on its way through the filter.
struct ReadFunction
{
  std::string Name;
  bool IsOnPoints = true;
  Vector<double> Given;      ///< by vertex or face
  Vector<double> AtVertices; ///< what is filtered
};

/// A flow of a dataset.
struct ReadFlow
{
  std::string Name;
  bool IsOnPoints = true;
  Vector<Complex> Given;     ///< tangential, by vertex or face
  Vector<double> AtVertices; ///< what is filtered as a whole
  DecomposedFlow Parts;      ///< what is filtered else
};

/// All that is filtered.
struct ReadQuantities
{
  std::vector<ReadFunction> Functions;
  std::vector<ReadFlow> Flows;
};

/// Scale filters for the surface of a dataset, and the arrays that show their results; kept for the next call on the same surface. Keys are
/// contents, not modification times.
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

  /// Adds the arrays of vtkScaleFilter to the output of a view of the surface.
  /// \param spectrum an empty table.
  /// \return warnings for the user.
  /// \throw InvalidInput as ScaleFilter, HodgeDecomposition and SpectrumBounds.
  std::vector<std::string> Filter(const QuantityArrays& quantities, const ScaleOptions& options,
    const SurfaceView& view, vtkTable* spectrum, const ExecutionContext& context);
  /// The same for quantities that were read already, not by parts.
  std::vector<std::string> Filter(ReadQuantities quantities, const ScaleOptions& options, const SurfaceView& view,
    vtkTable* spectrum, const ExecutionContext& context);

  struct StageCounts
  {
    int Setups = 0; ///< of solvers on the surface
    int Splits = 0; ///< of quantities at wavelengths, with those of spectra
  };
  /// Over all surfaces.
  const StageCounts& Counts() const { return this->CountsOfStages; }

private:
  class Run;

  ScaleFilter& OfFunctions(const ExecutionContext& context)
  {
    return this->Take(this->Functions, ScaledQuantity::Function, context);
  }
  ScaleFilter& OfVectors(const ExecutionContext& context)
  {
    return this->Take(this->Vectors, ScaledQuantity::Vectors, context);
  }
  FlowScales& OfFlows(const ExecutionContext& context);
  ScaleFilterOptions OptionsOf(ScaledQuantity quantity) const;
  const FramedMesh& On() const { return this->OfOthers ? *this->OfOthers : this->Prepared->Geometry; }
  static std::vector<std::string> Finish(
    Run& run, const ScaleOptions& options, vtkTable* spectrum, const ExecutionContext& context);
  /// Makes a filter, where there is none.
  ScaleFilter& Take(std::optional<ScaleFilter>& filter, ScaledQuantity quantity, const ExecutionContext& context);

  Settings Given;
  std::shared_ptr<const PreparedDataSet> Prepared;
  const FramedMesh* OfOthers = nullptr; ///< the surface of SetFilters
  MakeFilter Make;
  Unfilled<Corner> CornersOfFaces;
  // These refer to the surface, and share the set-ups of the first.
  std::optional<HodgeDecomposition> Decomposition;
  std::optional<ScaleFilter> Functions, Vectors;
  std::optional<FlowScales> Flows;
  StageCounts CountsOfStages;
};

}

#endif

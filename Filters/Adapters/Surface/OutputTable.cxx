#include "Adapters/Surface/OutputTable.h"

#include "Adapters/Surface/ArrayNames.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"

#include <limits>
#include <string>

namespace dmg
{

bool OutputArray::IsNamed(const std::string& name) const
{
  const std::string own = this->Name;
  if (this->Last < this->First)
  {
    return name == own;
  }
  const std::string number = name.compare(0, own.size(), own) == 0 ? name.substr(own.size()) : "";
  if (number.empty() || number.size() > 9 || number.find_first_not_of("0123456789") != std::string::npos)
  {
    return false;
  }
  const int value = std::stoi(number);
  return value >= this->First && value <= this->Last;
}

const std::vector<OutputArray>& OutputTable()
{
  using namespace ArrayNames;
  constexpr unsigned Cells = OutputArray::Cells, Points = OutputArray::Points, Field = OutputArray::FieldData,
                     Columns = OutputArray::Columns, Both = Cells | Points;
  constexpr int AnyNumber = std::numeric_limits<int>::max();
  static const std::vector<OutputArray> table{
    // all filters that take a surface
    { "vtkOrientedSurfaceAlgorithm", 0, SurfacePreparation, Field, 1 },

    // the field, its edges, and its report
    { "vtkHarmonicFieldSolver", 0, "Direction", Both, 3, 0, 7 },
    { "vtkHarmonicFieldSolver", 0, "PowerField", Both, 2 },
    { "vtkHarmonicFieldSolver", 0, "FaceField", Cells, 3 },
    { "vtkHarmonicFieldSolver", 0, "ScalarFunction", Points, 1 },
    { "vtkHarmonicFieldSolver", 0, Prescribed, Both, 1 },
    { "vtkHarmonicFieldSolver", 0, ArrayNames::PrincipalValues, Both, 2 },
    { "vtkHarmonicFieldSolver", 0, SingularityIndex, Both, 1 },
    { "vtkHarmonicFieldSolver", 0, HarmonicBasisPrefix, Cells, 3, 1, AnyNumber },
    { "vtkHarmonicFieldSolver", 0, PositiveSide, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, NumberOfDirections, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, ArrayNames::Solver, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, Followed, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, Converged, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, LevelUnknowns, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, LevelNonZeros, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, OperatorComplexity, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, SetupSeconds, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, PrepareSeconds, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, SolveSeconds, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, SolverBytes, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, Eigenvalues, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, HarmonicBasisSize, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, GuidesTaken, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, GuidesTooFar, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, GuidesOnFarSide, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, GuidesPerpendicular, Field, 1 },
    { "vtkHarmonicFieldSolver", 0, GuidesFarthest, Field, 1 },
    { "vtkHarmonicFieldSolver", 1, Rotation, Cells, 1 },
    { "vtkHarmonicFieldSolver", 1, "OneForm", Cells, 1 },
    { "vtkHarmonicFieldSolver", 1, Prescribed, Cells, 1 },
    { "vtkHarmonicFieldSolver", 1, HarmonicBasisPrefix, Cells, 1, 1, AnyNumber },
    { "vtkHarmonicFieldSolver", 2, Iteration, Columns, 1 },
    { "vtkHarmonicFieldSolver", 2, Seconds, Columns, 1 },
    { "vtkHarmonicFieldSolver", 2, RelativeResidual, Columns, 1 },
    { "vtkHarmonicFieldSolver", 2, Energy, Columns, 1 },
    { "vtkHarmonicFieldSolver", 2, MassResidual, Columns, 1 },
    { "vtkHarmonicFieldSolver", 2, Returned, Columns, 1 },

    // a decomposed flow, its streamlines and boundaries
    { "vtkHodgeDecomposition", 0, GradientPart, Both, 3 },
    { "vtkHodgeDecomposition", 0, RotationalPart, Both, 3 },
    { "vtkHodgeDecomposition", 0, HarmonicPart, Both, 3 },
    { "vtkHodgeDecomposition", 0, Residual, Both, 3 },
    { "vtkHodgeDecomposition", 0, SteeringFlow, Both, 3 },
    { "vtkHodgeDecomposition", 0, Potential, Points, 1 },
    { "vtkHodgeDecomposition", 0, StreamFunction, Points, 1 },
    { "vtkHodgeDecomposition", 0, Divergence, Points, 1 },
    { "vtkHodgeDecomposition", 0, Vorticity, Points, 1 },
    { "vtkHodgeDecomposition", 0, NormalComponent, Cells, 1 },
    { "vtkHodgeDecomposition", 0, FlowEnergies, Field, 1 },
    { "vtkHodgeDecomposition", 0, FlowShares, Field, 1 },
    { "vtkHodgeDecomposition", 0, HarmonicCoefficients, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryPoint, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryLength, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryIsOpen, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryHalfCell, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryCirculation, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryFlux, Field, 1 },
    { "vtkHodgeDecomposition", 0, BoundaryStreamFunction, Field, 1 },
    { "vtkHodgeDecomposition", 0, "CellsWithoutFlow", Field, 1 },
    { "vtkHodgeDecomposition", 0, PositiveSide, Field, 1 },
    { "vtkHodgeDecomposition", 0, ArrayNames::Solver, Field, 1 },
    { "vtkHodgeDecomposition", 0, Converged, Field, 1 },
    { "vtkHodgeDecomposition", 0, SolverBytes, Field, 1 },
    { "vtkHodgeDecomposition", 1, StreamFunction, Points, 1 },
    { "vtkHodgeDecomposition", 2, Boundary, Cells, 1 },
    { "vtkHodgeDecomposition", 2, BoundaryLength, Cells, 1 },
    { "vtkHodgeDecomposition", 2, BoundaryIsOpen, Cells, 1 },
    { "vtkHodgeDecomposition", 2, BoundaryCirculation, Cells, 1 },
    { "vtkHodgeDecomposition", 2, BoundaryFlux, Cells, 1 },
    { "vtkHodgeDecomposition", 2, BoundaryStreamFunction, Cells, 1 },
    { "vtkHodgeDecomposition", 2, BoundaryTransport, Cells, 1 },

    // what is carried along shortest paths, and circles
    { "vtkParallelTransport", 0, TransportedVectors, Both, 3 },
    { "vtkParallelTransport", 0, GeodesicDistance, Points, 1 },
    { "vtkParallelTransport", 0, GeodesicAngle, Points, 1 },
    { "vtkParallelTransport", 0, LogarithmicMap, Points, 2 },
    { "vtkParallelTransport", 0, TextureCoordinates, Points, 2 },
    { "vtkParallelTransport", 0, MapPoint, Field, 1 },
    { "vtkParallelTransport", 0, PointsWithoutSource, Field, 1 },
    { "vtkParallelTransport", 0, PointsWithoutMap, Field, 1 },
    { "vtkParallelTransport", 0, PositiveSide, Field, 1 },
    { "vtkParallelTransport", 2, GeodesicDistance, Points, 1 },

    // distances, offset lines, paths, and their table
    { "vtkSurfaceDistance", 0, ArrayNames::Distance, Points, 1 },
    { "vtkSurfaceDistance", 0, NearestSource, Points, 1 },
    { "vtkSurfaceDistance", 0, DirectionFromSource, Points, 3 },
    { "vtkSurfaceDistance", 0, SourcesTaken, Field, 1 },
    { "vtkSurfaceDistance", 0, SourcesTooFar, Field, 1 },
    { "vtkSurfaceDistance", 0, PointsWithoutSource, Field, 1 },
    { "vtkSurfaceDistance", 0, LargestDistance, Field, 1 },
    { "vtkSurfaceDistance", 0, DistanceIsSigned, Field, 1 },
    { "vtkSurfaceDistance", 0, PositiveSide, Field, 1 },
    { "vtkSurfaceDistance", 0, "CellsWithoutData", Field, 1 },
    { "vtkSurfaceDistance", 1, ArrayNames::Distance, Points, 1 },
    { "vtkSurfaceDistance", 2, Target, Cells, 1 },
    { "vtkSurfaceDistance", 2, Source, Cells, 1 },
    { "vtkSurfaceDistance", 2, ArrayNames::Distance, Cells, 1 },
    { "vtkSurfaceDistance", 2, PathLength, Cells, 1 },
    { "vtkSurfaceDistance", 2, StraightLength, Cells, 1 },
    { "vtkSurfaceDistance", 3, Target, Columns, 1 },
    { "vtkSurfaceDistance", 3, Source, Columns, 1 },
    { "vtkSurfaceDistance", 3, ArrayNames::Distance, Columns, 1 },
    { "vtkSurfaceDistance", 3, PathLength, Columns, 1 },
    { "vtkSurfaceDistance", 3, StraightLength, Columns, 1 },

    // the report on scales, and their spectrum; all else is named after the arrays that are filtered, and a second
    // filter in a row keeps what the first has written
    { "vtkScaleFilter", 0, Wavelengths, Field, 1 },
    { "vtkScaleFilter", 0, ScaledFunctions, Field, 1 },
    { "vtkScaleFilter", 0, MeansBefore, Field, AnyNumber },
    { "vtkScaleFilter", 0, MeansAfter, Field, AnyNumber },
    { "vtkScaleFilter", 0, Iterations, Field, AnyNumber },
    { "vtkScaleFilter", 0, Converged, Field, 1 },
    { "vtkScaleFilter", 0, "CellsWithoutData", Field, 1 },
    { "vtkScaleFilter", 0, PositiveSide, Field, 1 },
    { "vtkScaleFilter", 1, Wavelength, Columns, 1 },
    { "vtkScaleFilter", 1, Wavenumber, Columns, 1 },

    // principal curvatures
    { "vtkPrincipalDirections", 0, MaximumDirection, Both, 3 },
    { "vtkPrincipalDirections", 0, MinimumDirection, Both, 3 },
    { "vtkPrincipalDirections", 0, MaximumCurvature, Both, 1 },
    { "vtkPrincipalDirections", 0, MinimumCurvature, Both, 1 },
    { "vtkPrincipalDirections", 0, Confidence, Both, 1 },
    { "vtkPrincipalDirections", 0, PositiveSide, Field, 1 },

    // drawings
    { "vtkFieldAngles", 0, "Angle", Cells, 1 },
    { "vtkFieldAngles", 0, PositiveSide, Field, 1 },
    { "vtkFieldLines", 0, "Length", Cells, 1 },
    { "vtkFieldLines", 0, "Branch", Cells, 1 },
    { "vtkFieldLines", 0, "Seed", Cells, 1 },
    { "vtkFieldLines", 0, "Magnitude", Points, 1 },
    { "vtkFieldLines", 0, "Normals", Points, 3 },
    { "vtkFieldGlyphs", 0, "Branch", Cells, 1 },
    { "vtkFieldGlyphs", 0, "Direction", Cells, 1 },
    { "vtkFieldGlyphs", 0, "Glyph", Cells, 1 },
    { "vtkFieldGlyphs", 0, "Magnitude", Cells, 1 },
    { "vtkFieldGlyphs", 0, "Normals", Points, 3 },
    { "vtkFieldSingularities", 0, "Index", Points, 1 },
    { "vtkFieldSingularities", 0, "NumberOfDirections", Points, 1 },
    { "vtkFieldSingularities", 0, "PointId", Points, 1 },
    { "vtkFieldSingularities", 0, "CellId", Points, 1 },
    { "vtkFieldSingularities", 0, "NumberOfAxes", Points, 1 },
    { "vtkFieldSingularities", 0, "Axis", Points, 3, 0, AnyNumber },
    { "vtkFieldSingularities", 0, "SpiralAngle", Points, 1 },
    { "vtkFieldSingularities", 0, "SumOfIndices", Field, 1 },
    { "vtkFieldSingularities", 0, "EulerCharacteristic", Field, 1 },
    { "vtkFieldSingularities", 1, "Jump", Cells, 1 },
    { "vtkFieldSingularities", 1, "Rotation", Cells, 1 },
    { "vtkFieldSingularities", 2, "Index", Cells, 1 },

    // quads
    { "vtkFieldQuads", 0, "Irregular", Points, 1 },
    { "vtkFieldQuads", 0, "ScaledJacobian", Cells, 1 },
    { "vtkFieldQuads", 0, "GridCoordinates", Points, 2 },
    { "vtkFieldQuads", 0, "CornersOnGrid", Cells, 8 },
    { "vtkFieldQuads", 0, "Singularities", Field, 1 },
    { "vtkFieldQuads", 0, "IrregularVertices", Field, 1 },
    { "vtkFieldQuads", 0, "IrregularWithoutSingularity", Field, 1 },
    { "vtkFieldQuads", 0, "FlippedTriangles", Field, 1 },
    { "vtkFieldQuads", 0, "TrianglesWithoutArea", Field, 1 },
    { "vtkFieldQuads", 0, "InvertedQuads", Field, 1 },
    { "vtkFieldQuads", 0, "LostRegions", Field, 1 },
    { "vtkFieldQuads", 0, "EulerCharacteristicOfSurface", Field, 1 },
    { "vtkFieldQuads", 0, "EulerCharacteristic", Field, 1 },
    { "vtkFieldQuads", 0, "RefinedTriangles", Field, 1 },
    { "vtkFieldQuads", 0, "SplitTriangles", Field, 1 },
    { "vtkFieldQuads", 0, "EdgesAgainstField", Field, 1 },
    { "vtkFieldQuads", 0, "DistanceFromQuads", Field, 1 },
    { "vtkFieldQuads", 0, "DistanceFromSurface", Field, 1 },
    { "vtkFieldQuads", 0, "FarthestPlace", Field, 1 },
    { "vtkFieldQuads", 0, "SymmetryPlane", Field, 1 },
    { "vtkFieldQuads", 0, "AreaShares", Field, 1 },
    { "vtkFieldQuads", 0, "RatioOfSizes", Field, 1 },
    { "vtkFieldQuads", 1, TextureCoordinates, Points, 2 },
    { "vtkFieldQuads", 2, "Irregular", Points, 1 },
    { "vtkFieldQuads", 2, "SignColor", Points, 3 },
  };
  return table;
}

namespace
{

void RemoveNamed(const OutputArray& row, vtkFieldData* data)
{
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (const char* const name = data->GetArrayName(i); name && row.IsNamed(name))
    {
      data->RemoveArray(i);
    }
  }
}

}

void RemoveOutputs(const std::string& filter, vtkDataSet* output)
{
  for (const OutputArray& row : OutputTable())
  {
    if (filter != row.Filter || row.Port != 0)
    {
      continue;
    }
    if (row.Places & OutputArray::Cells)
    {
      RemoveNamed(row, output->GetCellData());
    }
    if (row.Places & OutputArray::Points)
    {
      RemoveNamed(row, output->GetPointData());
    }
    if (row.Places & OutputArray::FieldData)
    {
      RemoveNamed(row, output->GetFieldData());
    }
  }
}

}

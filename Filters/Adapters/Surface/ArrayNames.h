#ifndef dmgArrayNames_h
#define dmgArrayNames_h

#include <string>

namespace dmg
{

/// The names of all arrays that the filters write, but for the values of a discretisation, which it names itself. The
/// headers of the filters tell their meaning.
namespace ArrayNames
{

// cells and points
std::string Direction(int k);
inline constexpr const char* Prescribed = "Prescribed";
inline constexpr const char* PrincipalValues = "PrincipalValues";
inline constexpr const char* SingularityIndex = "SingularityIndex";

inline constexpr const char* MaximumDirection = "MaximumDirection";
inline constexpr const char* MinimumDirection = "MinimumDirection";
inline constexpr const char* MaximumCurvature = "MaximumCurvature";
inline constexpr const char* MinimumCurvature = "MinimumCurvature";
inline constexpr const char* Confidence = "Confidence";

// cells and points: a decomposed flow
inline constexpr const char* GradientPart = "GradientPart";
inline constexpr const char* RotationalPart = "RotationalPart";
inline constexpr const char* HarmonicPart = "HarmonicPart";
inline constexpr const char* Residual = "Residual";
inline constexpr const char* SteeringFlow = "SteeringFlow";
inline constexpr const char* NormalComponent = "NormalComponent";
inline constexpr const char* Potential = "Potential";
inline constexpr const char* StreamFunction = "StreamFunction";
inline constexpr const char* Divergence = "Divergence";
inline constexpr const char* Vorticity = "Vorticity";

// cells and points: what is carried along shortest paths
inline constexpr const char* TransportedVectors = "TransportedVectors";
inline constexpr const char* GeodesicDistance = "GeodesicDistance";
inline constexpr const char* GeodesicAngle = "GeodesicAngle";
inline constexpr const char* LogarithmicMap = "LogarithmicMap";
inline constexpr const char* TextureCoordinates = "TextureCoordinates";

// field data: the same
inline constexpr const char* MapPoint = "MapPoint";
inline constexpr const char* PointsWithoutSource = "PointsWithoutSource";
inline constexpr const char* PointsWithoutMap = "PointsWithoutMap";

// points and lines: distances along a surface
inline constexpr const char* Distance = "Distance";
inline constexpr const char* NearestSource = "NearestSource";
inline constexpr const char* DirectionFromSource = "DirectionFromSource";

// field data: the same; columns of the table, and cells of the paths
inline constexpr const char* SourcesTaken = "SourcesTaken";
inline constexpr const char* SourcesTooFar = "SourcesTooFar";
inline constexpr const char* LargestDistance = "LargestDistance";
inline constexpr const char* DistanceIsSigned = "DistanceIsSigned";
inline constexpr const char* Target = "Target";
inline constexpr const char* Source = "Source";
inline constexpr const char* PathLength = "PathLength";
inline constexpr const char* StraightLength = "StraightLength";

// field data: a decomposed flow
inline constexpr const char* FlowEnergies = "FlowEnergies";
inline constexpr const char* FlowShares = "FlowShares";
inline constexpr const char* HarmonicCoefficients = "HarmonicCoefficients";
inline constexpr const char* BoundaryPoint = "BoundaryPoint";
inline constexpr const char* BoundaryLength = "BoundaryLength";
inline constexpr const char* Boundary = "Boundary";
inline constexpr const char* BoundaryTransport = "BoundaryTransport";
inline constexpr const char* BoundaryIsOpen = "BoundaryIsOpen";
inline constexpr const char* BoundaryHalfCell = "BoundaryHalfCell";
inline constexpr const char* BoundaryCirculation = "BoundaryCirculation";
inline constexpr const char* BoundaryFlux = "BoundaryFlux";
inline constexpr const char* BoundaryStreamFunction = "BoundaryStreamFunction";

// cells and points: functions and flows by scale
std::string BelowWavelength(const std::string& name, const std::string& wavelength);
std::string AboveWavelength(const std::string& name, const std::string& wavelength);

// field data: the same; CellsWithoutFlow is of these, too
inline constexpr const char* Wavelengths = "Wavelengths";
inline constexpr const char* ScaledFunctions = "ScaledFunctions";
inline constexpr const char* MeansBefore = "MeansBefore";
inline constexpr const char* MeansAfter = "MeansAfter";
inline constexpr const char* Iterations = "Iterations";

// columns of spectra, the last ones after the name of a quantity, and their field data
inline constexpr const char* Wavelength = "Wavelength";
inline constexpr const char* Wavenumber = "Wavenumber";
inline constexpr const char* PerOctave = " per octave";
inline constexpr const char* PerWavenumber = " per wavenumber";
inline constexpr const char* InBand = " in band";
inline constexpr const char* AllAbove = " above";
inline constexpr const char* Variance = " variance";
inline constexpr const char* HarmonicVariance = " harmonic variance";

// cells and edges
inline constexpr const char* HarmonicBasisPrefix = "HarmonicBasis ";
/// \param k from 1
std::string HarmonicBasis(int k);

// edges
inline constexpr const char* Rotation = "Rotation";

// columns of the convergence table
inline constexpr const char* Iteration = "Iteration";
inline constexpr const char* Seconds = "Seconds";
inline constexpr const char* RelativeResidual = "RelativeResidual";
inline constexpr const char* Returned = "Returned";
inline constexpr const char* Energy = "Energy";
inline constexpr const char* MassResidual = "MassResidual";

// field data: the surface on its way in
/// \param what as in "flow".
std::string CellsWithout(const std::string& what);
inline constexpr const char* SurfacePreparation = "SurfacePreparation";
inline constexpr const char* SurfaceOptions = "SurfaceOptions";
inline constexpr const char* PositiveSide = "PositiveSide";

// field data: the report
inline constexpr const char* NumberOfDirections = "NumberOfDirections";
inline constexpr const char* Solver = "Solver";
inline constexpr const char* Followed = "Followed";
inline constexpr const char* Converged = "Converged";
inline constexpr const char* LevelUnknowns = "LevelUnknowns";
inline constexpr const char* LevelNonZeros = "LevelNonZeros";
inline constexpr const char* OperatorComplexity = "OperatorComplexity";
inline constexpr const char* SetupSeconds = "SetupSeconds";
inline constexpr const char* PrepareSeconds = "PrepareSeconds";
inline constexpr const char* SolveSeconds = "SolveSeconds";
inline constexpr const char* SolverBytes = "SolverBytes";
inline constexpr const char* Eigenvalues = "Eigenvalues";
inline constexpr const char* HarmonicBasisSize = "HarmonicBasisSize";
inline constexpr const char* GuidesTaken = "GuidesTaken";
inline constexpr const char* GuidesTooFar = "GuidesTooFar";
inline constexpr const char* GuidesOnFarSide = "GuidesOnFarSide";
inline constexpr const char* GuidesPerpendicular = "GuidesPerpendicular";
inline constexpr const char* GuidesFarthest = "GuidesFarthest";

// field data: the operators
inline constexpr const char* ProlongationPrefix = "Prolongation.";
inline constexpr const char* ProlongationFormat = "Prolongation.Format";
inline constexpr const char* ProlongationDigest = "Prolongation.Digest";
inline constexpr const char* ProlongationOptions = "Prolongation.Options";
inline constexpr const char* NumbersOfVertices = "Prolongation.NumbersOfVertices";
inline constexpr const char* NumbersOfEdges = "Prolongation.NumbersOfEdges";
inline constexpr const char* NumbersOfFaces = "Prolongation.NumbersOfFaces";
inline constexpr const char* CellsOfFaces = "Prolongation.CellsOfFaces";
inline constexpr const char* PointsOfVertices = "Prolongation.PointsOfVertices";
/// \param part "Offsets", "Columns" or "Values" of operator \p name ("S0", "S1", "SX", "SP",
/// "Nodal") of a level.
std::string Prolongation(const std::string& name, int level, const std::string& part);

}

}

#endif

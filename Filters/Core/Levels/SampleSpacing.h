#ifndef dmgSampleSpacing_h
#define dmgSampleSpacing_h

namespace dmg
{

// The limits of levels of samples, in whatever way they are made.

/// The distance of samples of samples; it leaves one of four.
constexpr double DistanceOfCoarserSamples = 1.8;
/// The curvature of the region that a sample covers, in radians. Larger limits cost iterations on surfaces full of folds.
constexpr double LargestCurvatureOfElements = 0.5;
constexpr double LargestCurvatureOfSamples = 1.0;
/// A level of fewer samples is factored. Fewer levels represent fields of low energy better.
constexpr int FewestSamplesToSample = 1500;
/// A level that keeps more of the points than this is not worth its cost.
constexpr double LargestUsefulRatio = 0.5;

}

#endif

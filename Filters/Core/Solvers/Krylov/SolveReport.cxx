#include "Solvers/Krylov/SolveReport.h"

namespace dmg
{

double SolveReport::OperatorComplexity() const
{
  if (this->Levels.empty() || this->Levels.front().NonZeros == 0)
  {
    return 1.0;
  }
  long long nonZeros = 0;
  for (const LevelReport& level : this->Levels)
  {
    nonZeros += level.NonZeros;
  }
  return static_cast<double>(nonZeros) / static_cast<double>(this->Levels.front().NonZeros);
}

}

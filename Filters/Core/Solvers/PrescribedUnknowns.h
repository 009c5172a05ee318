#ifndef dmgPrescribedUnknowns_h
#define dmgPrescribedUnknowns_h

#include "Support/Types.h"

#include <vector>

namespace dmg
{

enum class ConstraintKind
{
  Soft, ///< a penalty with a weight; prescriptions may disagree
  Hard, ///< holds exactly
};

/// Unknowns that are prescribed, and how strongly.
struct PrescribedUnknowns
{
  ConstraintKind Kind = ConstraintKind::Soft;
  std::vector<int> Unknowns; ///< ascending, each once
  Vector<double> Alignment;  ///< soft: m_b, one per unknown, >= 0, its weight included
};

}

#endif

#ifndef dmgBenchmarksMpiAlone_h
#define dmgBenchmarksMpiAlone_h

#include <cstdlib>

namespace dmg::peers
{

/// Before MPI starts: this process will not ask for others, and Open MPI needs no daemon for it.
inline void PrepareMpiForOneProcess()
{
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
}

}

#endif

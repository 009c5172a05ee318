#ifndef RegisterInitializationHelpers_h
#define RegisterInitializationHelpers_h

/// Lets ParaView make the initialization helpers and the representations of the plugin by their names. The plugin calls it when it is loaded.
void RegisterInitializationHelpers();

#endif

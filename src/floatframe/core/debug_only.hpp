#pragma once
// Statements of builds with asserts. A release build does not even see them: an empty function
// would move registers in the code around its call.
#ifdef NDEBUG
#define FLOATFRAME_DEBUG(...)
#else
#define FLOATFRAME_DEBUG(...) __VA_ARGS__
#endif

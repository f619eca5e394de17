#include "framework/component/assembly.h"

#include "framework/component/inertia.h"

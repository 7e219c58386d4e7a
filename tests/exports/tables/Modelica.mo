within;
package Modelica "The few classes of the Modelica Standard Library that the example needs, with the same connectors"
  package Mechanics
    package Rotational
      package Interfaces
        connector Flange_a
          Real phi;
          flow Real tau;
        end Flange_a;
        connector Flange_b
          Real phi;
          flow Real tau;
        end Flange_b;
      end Interfaces;
      package Components
        model Inertia
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          parameter Real J = 1;
          Real phi;
          Real w;
        equation
          phi = flange_a.phi;
          phi = flange_b.phi;
          w = der(phi);
          J*der(w) = flange_a.tau + flange_b.tau;
        end Inertia;
      end Components;
      package Sources
        model Torque
          input Real tau;
          Interfaces.Flange_b flange;
        equation
          flange.tau = -tau;
        end Torque;
      end Sources;
    end Rotational;
    package Translational
      package Interfaces
        connector Flange_a
          Real s;
          flow Real f;
        end Flange_a;
        connector Flange_b
          Real s;
          flow Real f;
        end Flange_b;
      end Interfaces;
      package Components
        model Mass
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          parameter Real m = 1;
          Real s;
          Real v;
        equation
          s = flange_a.s;
          s = flange_b.s;
          v = der(s);
          m*der(v) = flange_a.f + flange_b.f;
        end Mass;
      end Components;
      package Sources
        model ConstantForce
          parameter Real f_constant = 0;
          Interfaces.Flange_b flange;
        equation
          flange.f = -f_constant;
        end ConstantForce;
      end Sources;
    end Translational;
  end Mechanics;
  package Blocks
    package Sources
      model Sine
        parameter Real amplitude = 1;
        parameter Real f = 1;
        parameter Real offset = 0;
        output Real y;
      equation
        y = offset + amplitude*sin(6.283185307179586*f*time);
      end Sine;
    end Sources;
  end Blocks;
end Modelica;

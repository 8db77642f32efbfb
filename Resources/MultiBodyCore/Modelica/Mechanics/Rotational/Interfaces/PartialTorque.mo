within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialTorque "Source of a torque"
  extends PartialElementaryOneFlangeAndSupport2;
  SI.Angle phi "Angle of the flange less that of the support";
equation
  phi = flange.phi - phi_support;
  annotation (Documentation(info="<html><p>Base class of sources of a torque.</p></html>"));
end PartialTorque;
